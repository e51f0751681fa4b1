#include "modules/dynamics_ode/rotation.h"

#include <algorithm>
#include <cmath>

namespace presa::ode {
namespace {

constexpr double kMaxAngle = 0.025;  // [rad] per Runge-Kutta step
constexpr int kMaxSubsteps = 64;

Vec3 spin(const Quat& q, const Mat3& inverse_inertia, const Vec3& momentum_W) {
  return q * (inverse_inertia * (q.conjugate() * momentum_W));
}

// q' = 1/2 (0, w) q for a quaternion that need not be of unit length between the stages
Eigen::Vector4d rate(const Eigen::Vector4d& xyzw, const Mat3& inverse_inertia, const Vec3& momentum_W) {
  const Quat q(xyzw);
  const Vec3 w = spin(q.normalized(), inverse_inertia, momentum_W);
  return 0.5 * (Quat(0, w.x(), w.y(), w.z()) * q).coeffs();
}

}  // namespace

void driftRotation(Quat& q_WB, Vec3& w_WB, const Mat3& inertia, const Mat3& inverse_inertia, double h) {
  const Vec3 momentum_W = q_WB * (inertia * (q_WB.conjugate() * w_WB));
  const int substeps = std::clamp(static_cast<int>(std::ceil(w_WB.norm() * h / kMaxAngle)), 1, kMaxSubsteps);
  const double s = h / substeps;
  Eigen::Vector4d x = q_WB.coeffs();
  for (int i = 0; i < substeps; ++i) {
    const Eigen::Vector4d k1 = rate(x, inverse_inertia, momentum_W);
    const Eigen::Vector4d k2 = rate(x + 0.5 * s * k1, inverse_inertia, momentum_W);
    const Eigen::Vector4d k3 = rate(x + 0.5 * s * k2, inverse_inertia, momentum_W);
    const Eigen::Vector4d k4 = rate(x + s * k3, inverse_inertia, momentum_W);
    x += s / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    x.normalize();
  }
  q_WB.coeffs() = x;
  w_WB = spin(q_WB, inverse_inertia, momentum_W);
}

}  // namespace presa::ode
