#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <limits>

#include "modules/dynamics_ode/contact_solver/contact_problem.h"

namespace presa::ode {

/// One scalar row on the velocities of two bodies, of a joint or a motor: impulse = k (goal - u), between `low` and
/// `high`, with u = J_A v_A + J_B v_B. Stiff and unbounded it holds u at `goal`; bounded from one side it is a stop, from
/// both a motor or friction.
struct AxisRow {
  using Vec6 = Eigen::Matrix<double, 6, 1>;  ///< linear of the centre of mass, angular
  static constexpr double kUnbounded = std::numeric_limits<double>::infinity();

  std::int32_t A = ContactProblem::kFixed, B = ContactProblem::kFixed;
  Vec6 J_A = Vec6::Zero(), J_B = Vec6::Zero();
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

}  // namespace presa::ode
