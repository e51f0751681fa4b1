#include "framework/haptics/virtual_coupling.h"

#include <cmath>

namespace presa {

void addStiffness(const Mat3& S, const Vec3& p, Mat6& stiffness) noexcept {
  Mat3 arm;
  arm << 0, -p.z(), p.y(), p.z(), 0, -p.x(), -p.y(), p.x(), 0;
  const Mat3 turned = S * arm;
  stiffness.topLeftCorner<3, 3>() += S;
  stiffness.topRightCorner<3, 3>() -= turned;
  stiffness.bottomLeftCorner<3, 3>() -= turned.transpose();
  stiffness.bottomRightCorner<3, 3>() -= arm * turned;
}

Vec3 turnBetween(const Quat& from, const Quat& to) noexcept {
  Quat turn = to * from.conjugate();
  if (turn.w() < 0) turn.coeffs() *= -1;
  const double sine = turn.vec().norm();
  return sine > 1e-12 ? Vec3(2 * std::atan2(sine, turn.w()) / sine * turn.vec()) : Vec3(2 * turn.vec());
}

Pose movedBy(const Pose& X_WT, const Vec6& step) noexcept {
  const Vec3 turn = step.tail<3>();
  const double angle = turn.norm(), half = angle / 2;
  const double share = angle > 1e-12 ? std::sin(half) / angle : 0.5;
  const Quat by(std::cos(half), share * turn.x(), share * turn.y(), share * turn.z());
  return {X_WT.p + step.head<3>(), (by * X_WT.q).normalized()};
}

namespace {

/// Damper of a part of the coupling, motion or turn: its force and its resistance.
struct Damper {
  Vec3 force;
  Mat3 resistance;
};

// `stretch`: of the spring at the end of the last tick. It gives the direction of a damper along the spring, which
// hence stays the same while a tick looks for its balance.
Damper damperOf(double damping, bool along, const Vec3& moved, const Vec3& stretch) noexcept {
  if (!along) return {-damping * moved, damping * Mat3::Identity()};
  const double length = stretch.norm();
  if (!(length > 0)) return {Vec3::Zero(), Mat3::Zero()};
  const Vec3 d = stretch / length;
  const double back = moved.dot(d);
  if (!(back > 0)) return {Vec3::Zero(), Mat3::Zero()};  // moves away from the handle
  return {-damping * back * d, damping * d * d.transpose()};
}

}  // namespace

CouplingForce couplingForce(const ToolCoupling& coupling, const Pose& X_WH, const Pose& X_WT, const Vec6& moved,
                            double period) noexcept {
  CouplingForce force;
  const Vec3 stretch = X_WH.p - X_WT.p, turn = turnBetween(X_WT.q, X_WH.q);
  const Vec3 way = moved.head<3>(), turned = moved.tail<3>();
  const bool along = coupling.damping_along;
  const Damper straight = damperOf(coupling.damping / period, along, way, stretch + way);
  const Damper turning = damperOf(coupling.turn_damping / period, along, turned, turn + turned);
  force.wrench << saturated(coupling.stiffness * stretch, coupling.max_force) + straight.force,
      saturated(coupling.turn_stiffness * turn, coupling.max_torque) + turning.force;
  force.stiffness.topLeftCorner<3, 3>() = straight.resistance;
  force.stiffness.bottomRightCorner<3, 3>() = turning.resistance;
  force.stiffness.diagonal().head<3>().array() += coupling.stiffness;
  force.stiffness.diagonal().tail<3>().array() += coupling.turn_stiffness;
  return force;
}

}  // namespace presa
