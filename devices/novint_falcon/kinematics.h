#pragma once
#include <optional>

#include "devices/novint_falcon/packet.h"
#include "framework/core/math/spatial.h"

/// Kinematics and statics of a Novint Falcon, a delta mechanism after Stamper with three legs around the device's z
/// axis. Frame D of the device: origin at the centre of the base plate, z out of the device towards the user (the grip
/// moves in about z = 0.08..0.17 m), legs at azimuths 105, -15 and -135 degrees about z.
/// Thread: any; nonblocking, nothing is allocated.
namespace presa::falcon {

/// Counts per torque at the thigh [1/(N m)]; never calibrated (10 to 20 % at best).
inline constexpr double kCountsPerTorque = 10000;

/// Angle of the driven links (thighs) from the base plate, one per leg [rad].
using ThighAngles = Vec3;

/// Thigh angles from encoder counts of referenced encoders.
ThighAngles thighAngles(const Counts& encoders) noexcept;

/// Inverse kinematics for the grip at p_DH [m]; nullopt where a leg does not reach.
std::optional<ThighAngles> inverse(const Vec3& p_DH) noexcept;

/// d(thigh angles)/d(position), 3 x 3 [rad/m]; nullopt where a leg does not reach or is stretched.
std::optional<Mat3> inverseJacobian(const Vec3& p_DH) noexcept;

/// Centre of the workspace: default start of the search in `direct`.
inline const Vec3 kCentre{0, 0, 0.11};

/// Forward kinematics by Newton's method from `start`, and again from kCentre when that fails; residual at most 1e-13
/// rad. Nullopt when the angles have no solution or are not finite.
std::optional<Vec3> direct(const ThighAngles& angles, const Vec3& start = kCentre) noexcept;

/// Motor commands for a force on the grip f_H_D [N] at p_DH: counts = -counts_per_torque * (dp/dtheta)^T f. When a
/// motor would exceed `limit`, all three are scaled by one factor, which keeps the direction. Nullopt when the force is
/// not finite or the mechanism cannot produce it here. Each count is within +-limit.
std::optional<Counts> motorCounts(const Vec3& f_H_D, const Vec3& p_DH, int limit = kMaxCounts,
                                  double counts_per_torque = kCountsPerTorque) noexcept;

}  // namespace presa::falcon
