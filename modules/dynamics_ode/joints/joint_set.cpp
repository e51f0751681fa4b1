#include "modules/dynamics_ode/joints/joint_set.h"

#include <cmath>
#include <numbers>

#include "modules/dynamics_ode/joints/joint_pose.h"

namespace presa::ode {
namespace {

constexpr double kLessThanATurn = 6;  // [rad]

bool needsPosition(const JointAxis& axis) { return axis.lower || axis.upper || axis.stiffness > 0; }

// Between two stops an angle is known from the pose alone, also after turns that nobody read.
double startOf(const JointAxis& axis, double last) {
  const bool bounded = axis.lower && axis.upper && *axis.upper - *axis.lower < kLessThanATurn;
  return bounded ? (*axis.lower + *axis.upper) / 2 : last;
}

double nearest(double angle, double to) { return to + std::remainder(angle - to, 2 * std::numbers::pi); }

}  // namespace

JointSet::JointSet(const World& world, const BodySet& bodies) {
  const Scene& scene = world.scene;
  for (const Joint& joint : scene.joints) {
    Link& link = links_.emplace_back();
    link.joint = &joint;
    const bool to_world = joint.to == Joint::kWorld;
    link.X_WB = scene.bodies[joint.body].X_WB;
    link.X_WA = to_world ? Pose() : scene.bodies[joint.to].X_WB;
    link.frames = framesOf(joint, link.X_WB, link.X_WA);
    if (!bodies.isFixed(joint.body)) link.frames.X_BJ.p -= world.inertias[joint.body].p_BCm;
    if (!to_world && !bodies.isFixed(joint.to)) link.frames.X_AJ.p -= world.inertias[joint.to].p_BCm;
  }
}

// A fixed body of the scene has no state of its own.
Pose JointSet::poseNow(std::size_t body, const Pose& start, const BodySet& bodies) {
  return body == Joint::kWorld || bodies.isFixed(body) ? start : bodies.centrePose(body);
}

void JointSet::link(const BodySet& bodies, Islands& islands) const {
  for (const Link& link : links_) {
    const std::size_t A = link.joint->to, B = link.joint->body;
    if (A != Joint::kWorld && bodies.moves(A) && bodies.moves(B)) islands.link(A, B);
  }
}

void JointSet::read(const BodySet& bodies) {
  for (Link& link : links_) {
    const Joint& joint = *link.joint;
    link.at = jointPoseOf(link.frames, poseNow(joint.body, link.X_WB, bodies), poseNow(joint.to, link.X_WA, bodies));
    for (std::size_t i = 0; i < joint.axes.size(); ++i) {
      if (!needsPosition(joint.axes[i])) continue;
      const JointAxis& axis = joint.axes[i];
      const double position = positionOf(joint, i, link.at);
      link.position[i] = axis.turns ? nearest(position, startOf(axis, link.position[i])) : position;
    }
  }
}

std::size_t JointSet::movingBody(std::size_t i, const BodySet& bodies) const {
  const Joint& joint = *links_[i].joint;
  if (joint.to != Joint::kWorld && bodies.awake(joint.to) && !bodies.awake(joint.body)) return joint.to;
  if (bodies.moves(joint.body)) return joint.body;
  return joint.to != Joint::kWorld && bodies.moves(joint.to) ? joint.to : bodies.size();
}

ContactProblem::Joint JointSet::problemOf(std::size_t i, const BodySet& bodies, std::int32_t A, std::int32_t B) const {
  const Link& link = links_[i];
  const auto placed = [&](std::int32_t in, std::size_t body, const Pose& start, const Pose& X_J) {
    return in == ContactProblem::kFixed ? poseNow(body, start, bodies) * X_J : X_J;
  };
  ContactProblem::Joint joint;
  joint.A = A;
  joint.B = B;
  joint.joint = link.joint;
  joint.frames.X_AJ = placed(A, link.joint->to, link.X_WA, link.frames.X_AJ);
  joint.frames.X_BJ = placed(B, link.joint->body, link.X_WB, link.frames.X_BJ);
  joint.begin = link.at;
  joint.position = link.position;
  joint.f_B_W = link.f_B_W;
  joint.lead = link.next_lead;
  return joint;
}

}  // namespace presa::ode
