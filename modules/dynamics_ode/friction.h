#pragma once
#include "framework/math/spatial.h"
#include "framework/scene/scene.h"

namespace presa::ode {

/// Friction between two bodies: the geometric mean of their materials' coefficients, static while the surfaces rest
/// on each other and dynamic once they slide.
double pairFriction(const Material& a, const Material& b, double slip_speed);
/// Slip slower than this counts as rest [m/s].
inline constexpr double kRestSpeed = 1e-3;

/// Motion a body would have at the end of the step if nothing touched it but fingers: centre of mass, velocities.
struct PredictedMotion {
  Vec3 p_WCm = Vec3::Zero();
  Vec3 v_WCm = Vec3::Zero();
  Vec3 w_WB = Vec3::Zero();
  Vec3 at(const Vec3& p_W) const { return v_WCm + w_WB.cross(p_W - p_WCm); }
};

/// First friction direction at p_W for unit normal nhat_AB: along the slip of B on A that would follow without friction.
/// ODE bounds friction in two directions separately (a box, 41 % too strong between them); aligned with the coming
/// slip it is isotropic. When A and B would move alike (a stack), the tangential motion of B itself decides.
Vec3 slipDirection(const Vec3& nhat_AB, const Vec3& p_W, const PredictedMotion& A, const PredictedMotion& B);

}  // namespace presa::ode
