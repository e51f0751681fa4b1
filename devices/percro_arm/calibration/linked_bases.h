#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/core/math/spatial.h"

namespace presa {

/// The point that links two devices, at one moment, as each knows it in the frame of its own base [m].
struct LinkedSample {
  Vec3 p_A = Vec3::Zero(), p_B = Vec3::Zero();
};

struct LinkedBases {
  Pose X_AB;                   ///< base B seen from base A
  double residual = 0;         ///< root mean square of |p_A - X_AB p_B| [m]
  double condition = 0;        ///< of the normal equations, angles weighed as arcs at 0.1 m
  Vec3 spread = Vec3::Zero();  ///< of the points along their principal axes, largest first: standard deviations [m]
  double angle_error = 0,
         position_error = 0;  ///< expected standard errors for independent samples [rad], of B's origin [m]
  std::string refusal;        ///< why X_AB must not be used; empty: it may
};

/// Where B stands, so that the sum of squares of p_A - X_AB p_B is least [Arun1987], [Umeyama1991]. Refuses when the points lie
/// too near one line or one point to fix all six numbers, or do not fit a rigid motion.
LinkedBases fitBases(std::span<const LinkedSample> samples);

inline constexpr std::size_t kLeastSamples = 30;
inline constexpr double kMostCondition = 25;   ///< points spread by at least 20 mm beside their longest axis
inline constexpr double kMostResidual = 1e-3;  ///< [m]

}  // namespace presa
