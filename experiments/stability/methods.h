#pragma once
#include <algorithm>
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

/// The coupling that scenes of moderate stiffness get by default, here at any stiffness.
inline Method ours() { return {kPresa, {"dynamics/coupling=soft"}}; }
/// The haptic thread moves what fingers hold, `max_held` bodies at most, beside dynamics at 200 Hz alone.
inline Method hapticRate(std::size_t max_held = 3) {
  return {kPresa, {"dynamics/coupling=haptic_rate", "dynamics/max_held=" + std::to_string(max_held)}};
}
inline Method dynamicsRate() { return {"dynamics rate", {"dynamics/coupling=soft"}}; }
/// Explicit coupling: the rendered force of each finger acts on the body for one step.
inline Method explicitCoupling() { return {"explicit coupling", {"dynamics/coupling=explicit"}}; }
/// Gauss-Seidel sweeps in place of the direct solver.
inline Method twentyIterations() { return {"20 iterations", {"dynamics/solver=iterative", "dynamics/iterations=20"}}; }

/// "soft", "haptic rate", "explicit": for a column of the page; "" if the method leaves it to the scene.
inline std::string couplingOf(const Method& method) {
  const std::string path = "dynamics/coupling=";
  for (const std::string& set : method.sets) {
    if (!set.starts_with(path)) continue;
    std::string name = set.substr(path.size());
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
  }
  return {};
}

inline std::vector<std::string> operator+(std::vector<std::string> sets, const Method& method) {
  sets.insert(sets.end(), method.sets.begin(), method.sets.end());
  return sets;
}

}  // namespace presa::stability
