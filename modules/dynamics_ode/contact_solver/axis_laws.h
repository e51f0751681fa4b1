#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "framework/scene/joints/joint.h"

namespace presa::ode {

/// A spring on a velocity u: impulse = k (goal - u), between `low` and `high`. Stiff and unbounded it holds u at `goal`;
/// bounded from one side it is a stop, from both a motor or friction.
struct AxisLaw {
  static constexpr double kUnbounded = std::numeric_limits<double>::infinity();

  double goal = 0, k = 0;                       ///< [m/s, rad/s], [kg, kg m^2]
  double low = -kUnbounded, high = kUnbounded;  ///< [N s, N m s]

  double springAt(double u) const noexcept { return k * (goal - u); }
  double clamped(double spring) const noexcept { return std::clamp(spring, low, high); }
  bool gives(double spring) const noexcept { return low < spring && spring < high; }
  /// Minus the integral of the impulse over u.
  double potentialOf(double spring) const noexcept {
    if (spring > high) return high * (spring - high / 2) / k;
    if (spring < low) return low * (spring - low / 2) / k;
    return spring * spring / (2 * k);
  }
};

/// What acts along an axis of a joint in a step: stops, friction, motor, spring, damping, as far as it has them.
struct AxisLaws {
  std::size_t count = 0;
  std::array<AxisLaw, 6> law;

  std::span<const AxisLaw> all() const& noexcept { return std::span(law).first(count); }
  std::span<const AxisLaw> all() && = delete;  // a loop over it would outlive it
  AxisLaw& add(double k) noexcept {
    law[count].k = k;
    return law[count++];
  }
};

/// Whether lawsOf() gives any.
bool hasLaws(const JointAxis& axis) noexcept;

/// At `position` [m, rad] and speed `u` [m/s, rad/s] at the start of a step of `h` [s]. What is rigid has the stiffness
/// `k`. Stops that were passed push back with at most kMaxClosing or kMaxTurning.
AxisLaws lawsOf(const JointAxis& axis, double position, double u, double k, double h) noexcept;

/// Velocity at the end of a step of something with this inertia and one axis, which would have `free` without the laws:
/// where inertia (u - free) is the sum of their impulses. Exact: the sum is linear between the bounds.
double speedUnder(const AxisLaws& laws, double inertia, double free) noexcept;

}  // namespace presa::ode
