#include "modules/dynamics_ode/contact_solver/one_axis.h"

#include <cmath>

#include "modules/dynamics_ode/contact_solver/joint_rows.h"

namespace presa::ode {
namespace {

constexpr double kFollows = 1;  // (h omega)^2 of a swing up to which a step follows it

bool isOneOnAnAxis(const ContactProblem& problem) {
  if (problem.bodies.size() != 1 || problem.joints.size() != 1) return false;
  if (!problem.contacts.empty() || !problem.fingers.empty() || !problem.motors.empty()) return false;
  const ContactProblem::Joint& joint = problem.joints[0];
  const JointType type = joint.joint->type;
  return (joint.A == ContactProblem::kFixed) != (joint.B == ContactProblem::kFixed) &&
         (type == JointType::kHinge || type == JointType::kSlider);
}

// The joint as seen from what stands still.
struct Seat {
  double side;   // 1: body B moves, -1: body A
  Pose X_WJ;     // of what stands
  Pose X_CmJ;    // of what moves
  JointPose at;  // of what moves against what stands
};

Seat seatOf(const ContactProblem::Joint& joint) {
  if (joint.A == ContactProblem::kFixed) return {1, joint.frames.X_AJ, joint.frames.X_BJ, joint.begin};
  const Quat back = joint.begin.q_J.conjugate();
  return {-1, joint.frames.X_BJ, joint.frames.X_AJ, {back * -joint.begin.p_J, back}};
}

bool isOpen(const JointPose& at, bool turns, double h) {
  const double off = turns ? at.p_J.norm() : at.p_J.head<2>().norm();
  const double tilt = turns ? at.q_J.vec().head<2>().norm() : at.q_J.vec().norm();
  return !(off < h * kMaxClosing && 2 * tilt < h * kMaxTurning);
}

// How the body moves at unit speed, its inertia so, and what it has and gets.
struct Motion {
  Vec3 v_WCm, w_WB;
  double inertia, momentum, force;
  double pull;  // stiffness with which the forces swing it
};

Motion motionOf(const ContactProblem::Body& body, const Vec3& axis_W, const Vec3& p_WJ, bool turns) {
  Motion of;
  if (!turns) {
    of.v_WCm = axis_W;
    of.w_WB.setZero();
    of.inertia = body.mass;
    of.momentum = body.mass * axis_W.dot(body.v_WCm);
    of.force = axis_W.dot(body.force_W);
    of.pull = 0;
    return of;
  }
  const Vec3 r = body.p_WCm - p_WJ;
  const Mat3 R = body.q_WB.toRotationMatrix();
  const Vec3 L_W = R * (body.inertia_B * (R.transpose() * axis_W));
  of.v_WCm = axis_W.cross(r);
  of.w_WB = axis_W;
  of.inertia = axis_W.dot(L_W) + body.mass * of.v_WCm.squaredNorm();
  of.momentum = L_W.dot(body.w_WB) + body.mass * of.v_WCm.dot(body.v_WCm);
  of.force = axis_W.dot(body.torque_W) + of.v_WCm.dot(body.force_W);
  of.pull = body.force_W.dot(r) - body.force_W.dot(axis_W) * r.dot(axis_W);
  return of;
}

// The joint closed, its position further by `way`.
JointPose moved(const JointPose& at, bool turns, double way) {
  if (!turns) return {Vec3(0, 0, at.p_J.z() + way), Quat(std::copysign(1.0, at.q_J.w()), 0, 0, 0)};
  const double c = std::cos(way / 2), s = std::sin(way / 2), length = std::hypot(at.q_J.w(), at.q_J.z());
  const double w = at.q_J.w() / length, z = at.q_J.z() / length;
  return {Vec3::Zero(), Quat(w * c - z * s, 0, 0, z * c + w * s)};
}

}  // namespace

bool stepOnAxis(ContactProblem& problem, double h) noexcept {
  if (!isOneOnAnAxis(problem)) return false;
  ContactProblem::Body& body = problem.bodies[0];
  ContactProblem::Joint& joint = problem.joints[0];
  const JointAxis& axis = joint.joint->axes[0];
  const Seat seat = seatOf(joint);
  if (isOpen(seat.at, axis.turns, h)) return false;
  const Vec3 axis_W = seat.side * (seat.X_WJ.q * Vec3::UnitZ());
  const Motion of = motionOf(body, axis_W, seat.X_WJ.p, axis.turns);
  if (!(h * h * of.pull < kFollows * of.inertia)) return false;

  const double before = of.momentum / of.inertia;
  const AxisLaws laws = lawsOf(axis, joint.position[0], before, of.inertia / kJointSoftness, h);
  const double u = speedUnder(laws, of.inertia, before + h * of.force / of.inertia);

  const JointPose end = moved(seat.at, axis.turns, seat.side * h * u);
  body.q_WB = (seat.X_WJ.q * end.q_J * seat.X_CmJ.q.conjugate()).normalized();
  const Vec3 v_begin = body.v_WCm, p_JCm_W = body.q_WB * -seat.X_CmJ.p;
  body.p_WCm = seat.X_WJ.p + seat.X_WJ.q * end.p_J + p_JCm_W;
  body.v_WCm = axis.turns ? Vec3(u * axis_W.cross(p_JCm_W)) : Vec3(u * axis_W);
  body.w_WB = u * of.w_WB;
  joint.f_B_W = seat.side * (body.mass / h * (body.v_WCm - v_begin) - body.force_W);
  joint.lead = {};
  return true;
}

}  // namespace presa::ode
