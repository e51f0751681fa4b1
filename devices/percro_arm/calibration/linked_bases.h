#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/core/math/spatial.h"

namespace presa {

/// The linking point at one moment, in the frame of each device's base [m].
struct LinkedSample {
  Vec3 p_A = Vec3::Zero(), p_B = Vec3::Zero();
};

struct LinkedBases {
  Pose X_AB;                   ///< pose of base B in A
  double residual = 0;         ///< root mean square of |p_A - X_AB p_B| [m]
  double condition = 0;        ///< condition number of the normal equations, with angles scaled to arcs of 0.1 m
  Vec3 spread = Vec3::Zero();  ///< standard deviations of the points along their principal axes, largest first [m]
  double angle_error = 0,
         position_error = 0;  ///< expected standard errors for independent samples: [rad]; position of B's origin [m]
  std::string refusal;        ///< why X_AB must not be used; empty: it is valid
};

/// Least-squares fit of p_A = X_AB p_B [Arun1987], [Umeyama1991]. Refuses points that lie too close to one line or
/// point to determine all six parameters, and points that do not fit a rigid motion.
LinkedBases fitBases(std::span<const LinkedSample> samples);

inline constexpr std::size_t kMinSamples = 30;
inline constexpr double kMaxCondition = 25;   ///< points spread by at least 20 mm across their longest axis
inline constexpr double kMaxResidual = 1e-3;  ///< [m]

}  // namespace presa
