#pragma once
#include <string>
#include <vector>

#include "experiments/stability/case.h"

/// Physics methods, selected by scene values.
namespace presa::stability {

struct Method {
  std::string name;
  std::vector<std::string> sets;
  bool own() const { return name == kPresa; }
};

inline Method ours() { return {kPresa, {}}; }
/// The haptic thread moves what fingers hold, `max_held` bodies at most, beside dynamics at 200 Hz alone.
inline Method hapticRate(std::size_t max_held = 3) {
  return {kPresa, {"dynamics/coupling=haptic_rate", "dynamics/max_held=" + std::to_string(max_held)}};
}
inline Method dynamicsRate() { return {"dynamics rate", {"dynamics/coupling=soft"}}; }
/// Explicit coupling: the rendered force of each finger acts on the body for one step.
inline Method explicitCoupling() { return {"explicit coupling", {"dynamics/coupling=explicit"}}; }
/// Gauss-Seidel sweeps in place of the direct solver.
inline Method twentyIterations() { return {"20 iterations", {"dynamics/solver=iterative", "dynamics/iterations=20"}}; }

inline std::vector<std::string> operator+(std::vector<std::string> sets, const Method& method) {
  sets.insert(sets.end(), method.sets.begin(), method.sets.end());
  return sets;
}

}  // namespace presa::stability
