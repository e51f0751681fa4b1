#pragma once
#include <cmath>
#include <optional>

namespace presa::statistics {

constexpr double kGravity = 9.81;  ///< [m/s^2], the value of the grip study

/// Least normal force per digit that holds a mass between two fingers, m g / (2 mu) [N]: mu_s for an object at rest, mu_d
/// for one that slides already. mass >= 0 [kg], mu > 0, else no result.
inline std::optional<double> slipForce(double mass, double mu, double gravity = kGravity) {
  if (!(mass >= 0 && mu > 0) || !std::isfinite(mass) || !std::isfinite(gravity)) return std::nullopt;
  return mass * gravity / (2 * mu);
}

/// Two conventions of one margin, never under one name: both in percent, both 0 at the slip force and negative below it.
/// No result unless the grip force is > 0, the slip force >= 0, both finite. Any unit common to both forces.

/// 100 (grip - slip) / grip [Westling & Johansson 1984]: share of the grip that is not needed; never above 100, and 50 at
/// twice the slip force.
inline std::optional<double> relativeSafetyMargin(double grip, double slip) {
  if (!(grip > 0 && slip >= 0) || !std::isfinite(grip) || !std::isfinite(slip)) return std::nullopt;
  return 100 * (grip - slip) / grip;
}

/// 100 (grip - slip) / slip: what is added to the least force; no upper bound, and 100 at twice the slip force. No result
/// for slip force 0.
inline std::optional<double> marginOverSlipForce(double grip, double slip) {
  if (!relativeSafetyMargin(grip, slip) || slip == 0) return std::nullopt;
  return 100 * (grip - slip) / slip;
}

}  // namespace presa::statistics
