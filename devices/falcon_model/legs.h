#pragma once
#include <optional>

#include "framework/core/math/spatial.h"

/// Kinematics of a Falcon's three legs, as tori. A thigh rotates in its motor's plane; from the knee, two rigid end
/// pieces of total length kTube and a parallelogram of length kShin reach the grip. In the plane the distance from knee
/// to grip is kTube + sqrt(kShin^2 - y^2), where y is the offset of the grip across the plane. So the grip lies on a
/// torus around the knee, and the pose is the intersection of three tori. Frame D: origin at the centre of the motors,
/// z towards the user. Thread: any.
namespace presa::falcon_model {

inline constexpr double kThighAtZero = 0.61086523819801535;  ///< 35 degrees: thigh angle at count zero [rad]
/// 320 slots x 4 per turn of the motor, 14.25 mm capstan on a sector of 110 mm [rad per count].
inline constexpr double kThighPerCount = 2 * 3.14159265358979323846 / 1280 * 14.25 / 110;
inline constexpr double kTorquePerCount = -1e-4;  ///< [N m] at the thigh per count of a request

/// Thigh angles for the grip at p_D [rad]; nullopt where a leg cannot reach.
std::optional<Vec3> thighsAt(const Vec3& p_D);

/// Jacobian d(thighs)/d(p_D) [rad/m]. Its transpose maps thigh torques to the force on the grip.
Mat3 thighRates(const Vec3& p_D, const Vec3& thighs);

/// Forward kinematics, searched from a nearby position; nullopt when there is no solution.
std::optional<Vec3> gripAt(const Vec3& thighs, const Vec3& near_D);

}  // namespace presa::falcon_model
