#include "framework/scene/joints/joint_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace presa {
namespace {

double angleBetween(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

double angleOf(const Quat& q) { return 2 * std::atan2(q.vec().norm(), std::abs(q.w())); }

}  // namespace

std::size_t positionCount(const Joint& joint) noexcept {
  return joint.type == JointType::kFixed ? 0 : joint.type == JointType::kBall ? 1 : joint.axes.size();
}

bool isAngle(const Joint& joint, std::size_t i) noexcept {
  return joint.type == JointType::kBall || joint.axes[i].turns;
}

bool isJoined(const std::vector<Joint>& joints, std::size_t body) {
  return std::ranges::any_of(joints, [body](const Joint& joint) { return joint.body == body || joint.to == body; });
}

JointOpening openingOf(const Joint& joint, const JointPose& pose) noexcept {
  const double aside = std::hypot(pose.p_J.x(), pose.p_J.y());
  switch (joint.type) {
    case JointType::kFixed:
      return {pose.p_J.norm(), angleOf(pose.q_J)};
    case JointType::kSlider:
      return {aside, angleOf(pose.q_J)};
    case JointType::kHinge:
      return {pose.p_J.norm(), angleBetween(Vec3::UnitZ(), pose.q_J * Vec3::UnitZ())};
    case JointType::kUniversal: {
      const Vec3 second = pose.q_J * Vec3::UnitX();  // stays square to z of `to`
      return {pose.p_J.norm(), std::abs(std::atan2(second.z(), std::hypot(second.x(), second.y())))};
    }
    case JointType::kPrismaticRotary: {
      const Vec3 axis = secondAxis(joint);
      return {aside, angleBetween(axis, pose.q_J * axis)};
    }
    case JointType::kBall:
      break;
  }
  return {pose.p_J.norm(), 0};
}

JointMotion::JointMotion(const Scene& scene) : scene_(scene), states_(scene.joints.size()) {
  for (std::size_t j = 0; j < states_.size(); ++j) {
    const Joint& one = scene.joints[j];
    const Pose X_WA = one.to == Joint::kWorld ? Pose{} : scene.bodies[one.to].X_WB;
    states_[j].frames = framesOf(one, scene.bodies[one.body].X_WB, X_WA);
  }
}

void JointMotion::goOnFrom(const std::vector<double>& positions) noexcept {
  std::size_t next = 0;
  for (std::size_t j = 0; j < count(); ++j)
    for (std::size_t i = 0; i < positionCount(joint(j)); ++i, ++next)
      states_[j].position[i] = next < positions.size() ? positions[next] : 0;
}

void JointMotion::place(std::size_t j, const Pose& X_WB, const Pose& X_WA) noexcept {
  const Joint& one = joint(j);
  State& state = states_[j];
  state.pose = poseOf(state.frames, X_WB, X_WA);
  for (std::size_t i = 0; i < positionCount(one); ++i) {
    double& position = state.position[i];
    const double now = positionOf(one, i, state.pose);
    const bool goes_on = isAngle(one, i) && one.type != JointType::kBall;
    position = goes_on ? position + std::remainder(now - position, 2 * std::numbers::pi) : now;
  }
}

}  // namespace presa
