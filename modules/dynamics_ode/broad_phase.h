#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "modules/dynamics_ode/body_set.h"

namespace presa::ode {

/// Broad phase: sort and sweep along the axis on which the bodies are spread most. At a few hundred bodies as fast as
/// ODE's own spaces, but without memory allocation between steps.
class BroadPhase {
 public:
  using Pair = std::pair<std::size_t, std::size_t>;  ///< the lower index first

  explicit BroadPhase(const BodySet& bodies);

  /// Pairs whose bounds may overlap within `h` [s] or come within `margin` [m], with at least one body awake; in scene
  /// order, so that equal states give equal pairs.
  const std::vector<Pair>& find(const BodySet& bodies, double h, double margin);

 private:
  struct Bounds {
    dReal low[3], high[3];
    std::uint32_t body;
    bool awake;
  };
  static void measure(const BodySet& bodies, std::size_t i, double h, double margin, Bounds& out);
  static bool overlap(const Bounds& a, const Bounds& b, int axis) {
    return a.low[axis] <= b.high[axis] && b.low[axis] <= a.high[axis];
  }
  /// Fills `bounds_`; returns the bounds of all awake bodies together.
  Bounds measure(const BodySet& bodies, double h, double margin);
  static int longestAxis(const Bounds& all);

  std::vector<Bounds> bounds_;
  std::vector<Pair> pairs_;
};

}  // namespace presa::ode
