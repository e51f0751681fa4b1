#pragma once
#include "devices/novint_falcon/kinematics.h"
#include "framework/device/device_rating.h"

/// Limits of a Novint Falcon for the device and the hand. No file can raise them.
namespace presa::falcon {

inline constexpr DeviceRating kRating{.force = 8};  // its continuous rating is unknown

/// Upper bound for a rig's setting, 1.25 times the nominal value: the motor constant is uncertain by 10 to 20 %, and a
/// larger value would give forces above the rating.
inline constexpr double kMaxCountsPerTorque = 1.25 * kCountsPerTorque;
/// Max speed of a grip in a hand [m/s]; a faster one is a fault.
inline constexpr double kFastestGrip = 3;

}  // namespace presa::falcon
