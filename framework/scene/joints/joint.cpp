#include "framework/scene/joints/joint.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace presa {
namespace {

// Rotation about the unit vector `axis` that is the twist of `q`, in (-pi, pi].
double twistOf(const Quat& q, const Vec3& axis) {
  const double angle = 2 * std::atan2(q.vec().dot(axis), q.w());
  return std::remainder(angle, 2 * std::numbers::pi);
}

}  // namespace

const char* nameOf(JointType type) {
  switch (type) {
    case JointType::kFixed:
      return "fixed";
    case JointType::kHinge:
      return "hinge";
    case JointType::kSlider:
      return "slider";
    case JointType::kBall:
      return "ball";
    case JointType::kUniversal:
      return "universal";
    case JointType::kPrismaticRotary:
      break;
  }
  return "prismatic_rotary";
}

// z along the first axis; x along the part of the second square to it.
static Mat3 axesOf(const Joint& joint) {
  Mat3 R = Mat3::Identity();
  if (joint.type == JointType::kFixed || joint.type == JointType::kBall) return R;
  const Vec3 z = joint.axes[0].dhat_B;
  Vec3 x = joint.axes.size() > 1 ? Vec3(joint.axes[1].dhat_B - joint.axes[1].dhat_B.dot(z) * z) : Vec3(Vec3::Zero());
  x = x.norm() > 1e-6 ? Vec3(x.normalized()) : z.unitOrthogonal();
  R.col(0) = x;
  R.col(1) = z.cross(x);
  R.col(2) = z;
  return R;
}

JointFrames framesOf(const Joint& joint, const Pose& X_WB, const Pose& X_WA) {
  JointFrames frames;
  frames.X_BJ = {joint.p_BJ, Quat(axesOf(joint)).normalized()};
  frames.X_AJ = X_WA.inverse() * (X_WB * frames.X_BJ);
  frames.X_AJ.q.normalize();
  return frames;
}

JointPose poseOf(const JointFrames& frames, const Pose& X_WB, const Pose& X_WA) {
  const Pose in_B = X_WB * frames.X_BJ, in_A = X_WA * frames.X_AJ;
  const Quat back = in_A.q.conjugate();
  return {back * (in_B.p - in_A.p), back * in_B.q};
}

Vec3 secondAxis(const Joint& joint) { return axesOf(joint).transpose() * joint.axes[1].dhat_B; }

double positionOf(const Joint& joint, std::size_t i, const JointPose& pose) {
  switch (joint.type) {
    case JointType::kSlider:
      return pose.p_J.z();
    case JointType::kHinge:
      return twistOf(pose.q_J, Vec3::UnitZ());
    case JointType::kUniversal: {
      // a turn about z of `to`, then one about x of `body`
      const Vec3 x_J = pose.q_J * Vec3::UnitX();
      const double first = std::atan2(x_J.y(), x_J.x());
      if (i == 0) return first;
      return twistOf(Quat(Eigen::AngleAxisd(-first, Vec3::UnitZ())) * pose.q_J, Vec3::UnitX());
    }
    case JointType::kPrismaticRotary:
      return i == 0 ? pose.p_J.z() : twistOf(pose.q_J, secondAxis(joint));
    case JointType::kFixed:
    case JointType::kBall:
      break;
  }
  return 2 * std::atan2(pose.q_J.vec().norm(), std::abs(pose.q_J.w()));
}

}  // namespace presa
