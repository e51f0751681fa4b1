// Torque-free rotation of a rigid body. driftRotation: classical Runge-Kutta on the quaternion ODE q' = 1/2 w(q) q with
// constant angular momentum L_W, in sub-steps of at most kMaxAngle; w follows from q and L_W. Invariants: L_W to
// rounding, |q| = 1. eulerRotation and matrixRotation are conventional schemes for comparison.
#include "modules/dynamics_ode/rotation.h"

#include <algorithm>
#include <cmath>

namespace presa::ode {
namespace {

constexpr double kMaxAngle = 0.025;       // [rad] per Runge-Kutta step
constexpr double kMaxSeriesAngle = 0.05;  // [rad] per Magnus series
constexpr int kMaxSubsteps = 64;

int substepsOf(double angle, double max_angle) {
  return std::clamp(static_cast<int>(std::ceil(angle / max_angle)), 1, kMaxSubsteps);
}

Vec3 spin(const Quat& q, const Mat3& inverse_inertia, const Vec3& momentum_W) {
  return q * (inverse_inertia * (q.conjugate() * momentum_W));
}

// q' = 1/2 (0, w) q; the quaternion need not be normalised between the Runge-Kutta stages
Eigen::Vector4d rate(const Eigen::Vector4d& xyzw, const Mat3& inverse_inertia, const Vec3& momentum_W) {
  const Quat q(xyzw);
  const Vec3 w = spin(q.normalized(), inverse_inertia, momentum_W);
  return 0.5 * (Quat(0, w.x(), w.y(), w.z()) * q).coeffs();
}

// The rotation vector over `h` of a body with angular momentum L, in the axes of the body, from the derivatives of its
// angular velocity by Euler's equations L' = L x w. `spin_of(L)` is w.
template <class SpinOf>
Vec3 magnusTurn(const Vec3& L, const SpinOf& spin_of, double h) {
  const Vec3 w = spin_of(L), L1 = L.cross(w), w1 = spin_of(L1);
  const Vec3 L2 = L1.cross(w) + L.cross(w1), w2 = spin_of(L2);
  const Vec3 w3 = spin_of(L2.cross(w) + 2 * L1.cross(w1) + L.cross(w2));
  const Vec3 commutator = w.cross(w1 + h / 2 * w2) / 12;
  return h * (w + h * (w1 / 2 + h * (w2 / 6 + commutator + h / 24 * w3)));
}

// exp(turn / 2) by its series, to rounding for turns of kMaxSeriesAngle
Quat smallTurn(const Vec3& turn) {
  const double a = turn.squaredNorm() / 4;
  const double cosine = 1 - a / 2 * (1 - a / 12 * (1 - a / 30 * (1 - a / 56)));
  const Vec3 v = turn * (0.5 * (1 - a / 6 * (1 - a / 20 * (1 - a / 42))));
  return {cosine, v.x(), v.y(), v.z()};
}

// By a step of Newton's method, which doubles the digits of a norm that is nearly 1.
void renormalise(Quat& q) { q.coeffs() *= 1.5 - 0.5 * q.squaredNorm(); }

template <class SpinOf>
void turnFreely(Quat& q_WB, Vec3& w_WB, const Mat3& inertia, const SpinOf& spin_of, double h) {
  const double squared_angle = h * h * w_WB.squaredNorm();
  const bool is_small = !(squared_angle > kMaxSeriesAngle * kMaxSeriesAngle);
  const int substeps = is_small ? 1 : substepsOf(std::sqrt(squared_angle), kMaxSeriesAngle);
  Mat3 R = q_WB.toRotationMatrix();
  Vec3 L_B = inertia * (R.transpose() * w_WB);
  const Vec3 L_W = R * L_B;
  for (int i = 0; i < substeps; ++i) {
    q_WB = q_WB * smallTurn(magnusTurn(L_B, spin_of, h / substeps));
    renormalise(q_WB);
    R = q_WB.toRotationMatrix();
    L_B = R.transpose() * L_W;
  }
  w_WB = R * spin_of(L_B);
}

// of a symmetric matrix
bool isDiagonal(const Mat3& m) { return m(1, 0) == 0 && m(2, 0) == 0 && m(2, 1) == 0; }

}  // namespace

// Of most bodies the axes are principal ones: the same bits in less time.
void magnusRotation(Quat& q_WB, Vec3& w_WB, const Mat3& inertia, const Mat3& inverse_inertia, double h) {
  if (isDiagonal(inverse_inertia)) {
    const Vec3 inverse = inverse_inertia.diagonal();
    turnFreely(
        q_WB, w_WB, inertia, [&](const Vec3& L) -> Vec3 { return inverse.cwiseProduct(L); }, h);
  } else {
    turnFreely(
        q_WB, w_WB, inertia, [&](const Vec3& L) -> Vec3 { return inverse_inertia * L; }, h);
  }
}

void driftRotation(Quat& q_WB, Vec3& w_WB, const Mat3& inertia, const Mat3& inverse_inertia, double h) {
  const Vec3 momentum_W = q_WB * (inertia * (q_WB.conjugate() * w_WB));
  const int substeps = substepsOf(w_WB.norm() * h, kMaxAngle);
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
