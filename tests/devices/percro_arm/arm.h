#pragma once
#include "devices/percro_arm/parameters.h"

namespace presa::percro {

inline const Parameters kArm = paperArm();
inline const Vec3 kGravity{0, -9.81, 0};  // [m/s^2], y up

}  // namespace presa::percro
