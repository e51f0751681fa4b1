// Torque-free rotation of a rigid body. driftRotation: classical Runge-Kutta on the quaternion ODE q' = 1/2 w(q) q with
// constant angular momentum L_W, in sub-steps of at most kMaxAngle; w follows from q and L_W. Invariants: L_W to
// rounding, |q| = 1. eulerRotation and matrixRotation are conventional schemes for comparison.
#include "modules/dynamics_ode/rotation.h"

#include <algorithm>
#include <cmath>

namespace presa::ode {
namespace {

constexpr double kMaxAngle = 0.025;  // [rad] per step
constexpr int kMaxSubsteps = 64;

Vec3 spin(const Quat& q, const Mat3& inverse_inertia, const Vec3& momentum_W) {
  return q * (inverse_inertia * (q.conjugate() * momentum_W));
}

// q' = 1/2 (0, w) q; the quaternion need not be normalised between the Runge-Kutta stages
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

void eulerRotation(Quat& q_WB, Vec3& w_WB, const Mat3& inertia, const Mat3& inverse_inertia, double h) {
  const Vec3 w_B = q_WB.conjugate() * w_WB;
  q_WB.coeffs() += 0.5 * h * (Quat(0, w_WB.x(), w_WB.y(), w_WB.z()) * q_WB).coeffs();
  q_WB.normalize();
  w_WB = q_WB * Vec3(w_B - h * (inverse_inertia * w_B.cross(inertia * w_B)));
}

void matrixRotation(Quat& q_WB, const Vec3& w_WB, double h) {
  const Vec3 turn = h * (q_WB.conjugate() * w_WB);
  Mat3 skew;
  skew << 0, -turn.z(), turn.y(), turn.z(), 0, -turn.x(), -turn.y(), turn.x(), 0;
  Mat3 R = q_WB.toRotationMatrix() * (Mat3::Identity() + skew);
  R.col(0).normalize();
  R.col(1) = (R.col(1) - R.col(1).dot(R.col(0)) * R.col(0)).normalized();
  R.col(2) = R.col(0).cross(R.col(1));
  q_WB = Quat(R).normalized();
}

Vec3 turnBetween(const Quat& from, const Quat& to) {
  Quat turn = to * from.conjugate();
  if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
  const double sine = turn.vec().norm();
  if (sine < 1e-12) return 2 * turn.vec();
  return turn.vec() * (2 * std::atan2(sine, turn.w()) / sine);
}

}  // namespace presa::ode
