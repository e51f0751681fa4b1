#pragma once
#include "framework/core/math/spatial.h"
#include "framework/scene/scene.h"

namespace presa::ode {

/// Friction coefficient between two bodies: geometric mean of their materials' coefficients, static below kRestSpeed,
/// dynamic above.
double pairFriction(const Material& a, const Material& b, double slip_speed);
/// Slip speed below which surfaces count as resting [m/s].
inline constexpr double kRestSpeed = 1e-3;

/// First friction direction for unit normal nhat_AB, given the slip velocity predicted without friction [m/s]. ODE
/// bounds friction in two directions separately (a box, up to 41 % too strong diagonally); aligned with the predicted
/// slip it is isotropic. Without slip any direction is right.
Vec3 frictionDirection(const Vec3& nhat_AB, const Vec3& slip);

}  // namespace presa::ode
