#pragma once
#include "framework/core/math/spatial.h"
#include "framework/scene/scene.h"

namespace presa::ode {

/// Friction between two bodies: the geometric mean of their materials' coefficients, static while the surfaces rest
/// on each other and dynamic once they slide.
double pairFriction(const Material& a, const Material& b, double slip_speed);
/// Slip slower than this counts as rest [m/s].
inline constexpr double kRestSpeed = 1e-3;

/// First friction direction for unit normal nhat_AB, given the slip velocity that would follow without friction. ODE
/// bounds friction in two directions separately (a box, 41 % too strong between them); aligned with the coming slip
/// it is isotropic. Any direction will do where nothing would slip.
Vec3 frictionDirection(const Vec3& nhat_AB, const Vec3& slip);

}  // namespace presa::ode
