#pragma once
#include <string>
#include <vector>

#include "experiments/stability/case.h"

/// Physics methods, selected by scene values.
namespace presa::stability {

struct Method {
  std::string name;
  std::vector<std::string> sets;
  bool own() const { return sets.empty(); }
};

inline Method ours() { return {kPresa, {}}; }
/// Explicit coupling: the rendered force of each finger acts on the body for one step.
inline Method explicitCoupling() { return {"explicit coupling", {"dynamics/coupling=explicit"}}; }
/// Gauss-Seidel sweeps in place of the direct solver.
inline Method twentyIterations() { return {"20 iterations", {"dynamics/solver=iterative", "dynamics/iterations=20"}}; }

inline std::vector<std::string> operator+(std::vector<std::string> sets, const Method& method) {
  sets.insert(sets.end(), method.sets.begin(), method.sets.end());
  return sets;
}

}  // namespace presa::stability
