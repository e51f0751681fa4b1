#pragma once
#include "framework/math/spatial.h"
#include "framework/scene/scene.h"

namespace presa::ode {

/// Friction between two bodies: the geometric mean of their materials' coefficients, static while the surfaces rest
/// on each other and dynamic once they slide.
double pairFriction(const Material& a, const Material& b, double slip_speed);
/// Slip slower than this counts as rest [m/s].
inline constexpr double kRestSpeed = 1e-3;

/// Velocities of a body for points given at the start of the step.
struct Motion {
  Vec3 p_WCm = Vec3::Zero();
  Vec3 v_WCm = Vec3::Zero();
  Vec3 w_WB = Vec3::Zero();
  Vec3 at(const Vec3& p_W) const { return v_WCm + w_WB.cross(p_W - p_WCm); }
};

/// Tangential part of the velocity of B relative to A at p_W.
Vec3 slipVelocity(const Vec3& nhat_AB, const Vec3& p_W, const Motion& A, const Motion& B);

/// First friction direction for unit normal nhat_AB, given the slip velocity that would follow without friction. ODE
/// bounds friction in two directions separately (a box, 41 % too strong between them); aligned with the coming slip
/// it is isotropic. Any direction will do where nothing would slip.
Vec3 frictionDirection(const Vec3& nhat_AB, const Vec3& slip);

}  // namespace presa::ode
