#pragma once
#include "devices/novint_falcon/kinematics.h"
#include "framework/device/device_rating.h"

/// What a Novint Falcon bears and what a hand may meet from it. No file widens it.
namespace presa::falcon {

inline constexpr DeviceRating kRating{.force = 8};  // no continuous rating is known of it

/// The constant of the motors is uncertain by 10 to 20 %; a rig that says more than a quarter more would have forces beyond the rating.
inline constexpr double kMostCountsPerTorque = 1.25 * kCountsPerTorque;
/// Of a grip in a hand [m/s]: faster is no motion but a fault.
inline constexpr double kFastestGrip = 3;

}  // namespace presa::falcon
