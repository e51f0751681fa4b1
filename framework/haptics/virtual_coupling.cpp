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

CouplingForce couplingForce(const ToolCoupling& coupling, const Pose& X_WH, const Pose& X_WT, const Vec6& moved,
                            double period) noexcept {
  CouplingForce force;
  const double damping = coupling.damping / period, turn_damping = coupling.turn_damping / period;
  force.wrench.head<3>() = saturated(coupling.stiffness * (X_WH.p - X_WT.p), coupling.max_force);
  force.wrench.tail<3>() = saturated(coupling.turn_stiffness * turnBetween(X_WT.q, X_WH.q), coupling.max_torque);
  force.wrench.head<3>() -= damping * moved.head<3>();
  force.wrench.tail<3>() -= turn_damping * moved.tail<3>();
  force.stiffness.diagonal().head<3>().setConstant(coupling.stiffness + damping);
  force.stiffness.diagonal().tail<3>().setConstant(coupling.turn_stiffness + turn_damping);
  return force;
}

}  // namespace presa
