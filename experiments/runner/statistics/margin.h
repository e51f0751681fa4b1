#pragma once
#include <cmath>
#include <optional>

namespace presa::statistics {

constexpr double kGravity = 9.81;  ///< [m/s^2], the value of the grip study

/// Min normal force per digit that holds a mass between two fingers, m g / (2 mu) [N]: use mu_s for an object at rest,
/// mu_d for one that already slides. Nullopt unless mass >= 0 [kg] and mu > 0.
inline std::optional<double> slipForce(double mass, double mu, double gravity = kGravity) {
  if (!(mass >= 0 && mu > 0) || !std::isfinite(mass) || !std::isfinite(gravity)) return std::nullopt;
  return mass * gravity / (2 * mu);
}

/// The safety margin has two conventions, here under two names: both in percent, 0 at the slip force and negative below
/// it. Nullopt unless grip force > 0 and slip force >= 0, both finite. Both forces in the same unit.

/// 100 (grip - slip) / grip [Westling & Johansson 1984]: share of the grip that is not needed; never above 100, and 50 at
/// twice the slip force.
inline std::optional<double> relativeSafetyMargin(double grip, double slip) {
  if (!(grip > 0 && slip >= 0) || !std::isfinite(grip) || !std::isfinite(slip)) return std::nullopt;
  return 100 * (grip - slip) / grip;
}

/// 100 (grip - slip) / slip: the excess relative to the slip force; no upper bound, 100 at twice the slip force.
/// Nullopt for slip force 0.
inline std::optional<double> marginOverSlipForce(double grip, double slip) {
  if (!relativeSafetyMargin(grip, slip) || slip == 0) return std::nullopt;
  return 100 * (grip - slip) / slip;
}

}  // namespace presa::statistics
