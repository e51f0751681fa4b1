#pragma once
#include <optional>

#include "framework/core/math/spatial.h"

/// The three legs of a Falcon, seen as tori. A thigh turns in its motor's plane; from its knee on, two rigid ends of together
/// kTube and a parallelogram of length kShin reach the grip. In the plane the grip is kTube + sqrt(kShin^2 - y^2) away from the knee, y
/// its offset across the plane: it lies on a torus around the knee, and the pose is where three tori meet. Frame D: origin at the
/// centre of the motors, z towards the user. Thread: any.
namespace presa::falcon_model {

inline constexpr double kThighAtZero = 0.61086523819801535;  ///< 35 degrees: where the encoders count zero [rad]
/// 320 slots x 4 a turn of the motor, 14.25 mm capstan on a sector of 110 mm [rad per count].
inline constexpr double kThighPerCount = 2 * 3.14159265358979323846 / 1280 * 14.25 / 110;
inline constexpr double kTorquePerCount = -1e-4;  ///< [N m] at the thigh, by a word of the request

/// Thigh angles that hold the grip at p_D [rad]; nothing where a leg cannot reach.
std::optional<Vec3> thighsAt(const Vec3& p_D);

/// How they turn as the grip moves: d(thighs)/d(p_D) [rad/m]. Its transpose takes torques of the thighs to force on the grip.
Mat3 thighRates(const Vec3& p_D, const Vec3& thighs);

/// Where the grip is, found from a place near it; nothing when there is no such place.
std::optional<Vec3> gripAt(const Vec3& thighs, const Vec3& near_D);

}  // namespace presa::falcon_model
