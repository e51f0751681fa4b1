#include "modules/dynamics_ode/contact_solver/newton_rows.h"

#include <algorithm>
#include <cmath>

#include "framework/geometry/index.h"

namespace presa::ode::newton {
namespace {

constexpr double kSticks = 0.98;  // friction relative to its limit below which a contact is expected to stick

// Minus the derivative of a spring k that gives at most `limit` in two directions, at its unbounded impulse.
Eigen::Matrix2d clippedStiffness(const Eigen::Vector2d& spring, double limit, double k) {
  const double length = spring.norm();
  if (length <= limit) return k * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d along = spring / length;
  return k * limit / length * (Eigen::Matrix2d::Identity() - along * along.transpose());
}

}  // namespace

double huber(double spring, double limit, double k) {
  return spring <= limit ? spring * spring / (2 * k) : limit * (spring - limit / 2) / k;
}

void Row::startFrom(const Vec3& impulse_W) {
  impulse = R * impulse_W;
  normal = std::max(0.0, impulse.x());
  sticks = impulse.tail<2>().norm() < kSticks * mu * normal;
}

Vec3 Row::velocityIn(const Vector& v) const {
  const Vec6& of_B = v[index(B)];
  Vec3 u = of_B.head<3>() + Vec3(of_B.tail<3>()).cross(rB);
  if (A != ContactProblem::kFixed) {
    const Vec6& of_A = v[index(A)];
    u -= of_A.head<3>() + Vec3(of_A.tail<3>()).cross(rA);
  }
  return R * u;
}

Vec3 Row::springAt(const Vec3& u) const { return Vec3(k_n, k_t, k_t).cwiseProduct(goal - u); }

Vec3 Row::impulseAt(const Vec3& u) const {
  Vec3 at = springAt(u);
  at.x() = std::max(0.0, at.x());
  const double limit = mu * normal, length = at.tail<2>().norm();
  if (length > limit) at.tail<2>() *= limit / length;
  return at;
}

void Row::addPotential(const Vec3& u, double& value) const {
  const Vec3 spring = springAt(u);
  if (spring.x() > 0) value += spring.x() * spring.x() / (2 * k_n);
  value += huber(spring.tail<2>().norm(), mu * normal, k_t);
}

Response responseOf(const Row& row, const Vec3& u) {
  const Vec3 spring = row.springAt(u);
  Mat3 k = Mat3::Zero();
  if (spring.x() > 0) k(0, 0) = row.k_n;
  k.bottomRightCorner<2, 2>() = clippedStiffness(spring.tail<2>(), row.mu * row.normal, row.k_t);
  return {row.impulseAt(u), k};
}

Response expectedOf(const Row& row, const Vec3& u) {
  Vec3 impulse = Vec3::Zero(), k = Vec3::Zero();
  if (row.closes) {
    k.x() = row.k_n;
    if (row.sticks) {
      k.y() = k.z() = row.k_t;
    } else {
      impulse.tail<2>() = row.impulse.tail<2>();
    }
    impulse += k.cwiseProduct(row.goal - u);
  }
  return {impulse, Mat3(k.asDiagonal())};
}

Eigen::Vector2d Roll::velocityIn(const Vector& v) const {
  Vec3 w = v[index(B)].tail<3>();
  if (A != ContactProblem::kFixed) w -= v[index(A)].tail<3>();
  return T * w;
}

Eigen::Vector2d Roll::impulseAt(const Eigen::Vector2d& w, double limit) const {
  const Eigen::Vector2d spring = -k * w;
  const double size = spring.norm();
  return size > limit ? Eigen::Vector2d(limit / size * spring) : spring;
}

Eigen::Matrix2d Roll::stiffnessAt(const Eigen::Vector2d& w, double limit) const {
  return clippedStiffness(-k * w, limit, k);
}

double velocityIn(const AxisRow& row, const Vector& v) {
  double u = 0;
  if (row.B != ContactProblem::kFixed) u += row.J_B.dot(v[index(row.B)]);
  if (row.A != ContactProblem::kFixed) u += row.J_A.dot(v[index(row.A)]);
  return u;
}

}  // namespace presa::ode::newton
