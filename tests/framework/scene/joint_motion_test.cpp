// Joints from the poses of bodies: positions, turns, openings, words.
#include <cmath>
#include <numbers>

#include "framework/scene/joints/joint_motion.h"
#include "framework/scene/joints/joint_words.h"
#include "tests/framework/scene/scene_text.h"

namespace presa::scene_test {
namespace {

constexpr double kPi = std::numbers::pi;

Quat turnAbout(double angle, const Vec3& axis) { return Quat(Eigen::AngleAxisd(angle, axis.normalized())); }

/// Two bodies in start poses that are nothing special, and one joint from the second to the first.
Scene sceneWith(JointType type, const std::vector<Vec3>& axes) {
  Scene scene;
  scene.bodies.resize(2);
  scene.bodies[0].name = "frame", scene.bodies[1].name = "part";
  scene.bodies[0].X_WB = {{0.1, -0.2, 0.3}, turnAbout(0.7, {1, 2, 3})};
  scene.bodies[1].X_WB = {{-0.2, 0.1, 0.4}, turnAbout(-1.1, {2, -1, 1})};
  Joint joint;
  joint.name = "joint";
  joint.type = type;
  joint.body = 1, joint.to = 0;
  joint.p_BJ = {0.02, 0.03, -0.01};
  for (const Vec3& axis : axes) {
    joint.axes.emplace_back().dhat_B = axis.normalized();
    joint.axes.back().turns =
        type != JointType::kSlider && !(type == JointType::kPrismaticRotary && joint.axes.size() == 1);
  }
  scene.joints.push_back(joint);
  return scene;
}

/// Both bodies after the part moved by `d_B` and turned by `q_B` about the joint, in its start axes, and the pair was
/// carried somewhere else.
std::vector<Pose> moved(const Scene& scene, const Vec3& d_B, const Quat& q_B) {
  const Pose away{{0.5, 0.4, -0.3}, turnAbout(2.0, {-1, 0.5, 2})};
  const Vec3& p_BJ = scene.joints[0].p_BJ;
  const Pose step{p_BJ + d_B - q_B * p_BJ, q_B};
  return {away * scene.bodies[0].X_WB, away * (scene.bodies[1].X_WB * step)};
}

void followJoints(JointMotion& motion, const std::vector<Pose>& X_WB) {
  motion.follow([&](std::size_t body) { return X_WB[body]; });
}

TEST(JointMotion, PositionsAreWhatThePartWasMovedBy) {
  const Vec3 axis = Vec3(1, -2, 0.5).normalized();
  for (const JointType type : {JointType::kHinge, JointType::kSlider, JointType::kPrismaticRotary}) {
    std::vector<Vec3> axes{axis};
    if (type == JointType::kPrismaticRotary) axes.push_back(axis);
    const Scene scene = sceneWith(type, axes);
    JointMotion motion(scene);
    const double slides = type == JointType::kHinge ? 0 : 0.13, turns = type == JointType::kSlider ? 0 : -0.8;
    followJoints(motion, moved(scene, slides * axis, turnAbout(turns, axis)));
    const std::size_t last = positionCount(scene.joints[0]) - 1;
    EXPECT_NEAR(motion.position(0, last), type == JointType::kSlider ? slides : turns, 1e-12);
    if (last == 1) {
      EXPECT_NEAR(motion.position(0, 0), slides, 1e-12);
    }
    const JointOpening opening = openingOf(scene.joints[0], motion.pose(0));
    EXPECT_NEAR(opening.distance, 0, 1e-12);
    EXPECT_NEAR(opening.angle, 0, 1e-9);
  }
}

// Three turns forth and five back, in steps of 100 degrees.
TEST(JointMotion, AnglesGoOnBeyondHalfATurn) {
  const Scene scene = sceneWith(JointType::kHinge, {Vec3::UnitY()});
  JointMotion motion(scene);
  const double step = kPi / 1.8;
  double angle = 0;
  const auto go = [&](double by) {
    angle += by;
    followJoints(motion, moved(scene, Vec3::Zero(), turnAbout(angle, Vec3::UnitY())));
    EXPECT_NEAR(motion.position(0, 0), angle, 1e-9);
  };
  for (int i = 0; i < 11; ++i) go(step);
  for (int i = 0; i < 29; ++i) go(-step);
  motion.goOnFrom();
  followJoints(motion, moved(scene, Vec3::Zero(), turnAbout(angle, Vec3::UnitY())));
  EXPECT_NEAR(motion.position(0, 0), std::remainder(angle, 2 * kPi), 1e-9);
  motion.goOnFrom({angle + 1});
  followJoints(motion, moved(scene, Vec3::Zero(), turnAbout(angle, Vec3::UnitY())));
  EXPECT_NEAR(motion.position(0, 0), angle, 1e-9);
}

TEST(JointMotion, ABallTellsItsAngleAndAFixedJointNothing) {
  const Scene ball = sceneWith(JointType::kBall, {}), fixed = sceneWith(JointType::kFixed, {});
  JointMotion motion(ball);
  followJoints(motion, moved(ball, Vec3::Zero(), turnAbout(-2.5, {1, 1, 0})));
  EXPECT_EQ(positionCount(ball.joints[0]), 1u);
  EXPECT_NEAR(motion.position(0, 0), 2.5, 1e-12);
  EXPECT_EQ(positionCount(fixed.joints[0]), 0u);
}

// Pulled and bent in locked directions by known amounts, while free ones move too.
TEST(JointMotion, OpeningIsThePartOfAMotionThatTheJointLocks) {
  const Vec3 z = Vec3::UnitZ(), x = Vec3::UnitX();
  struct Case {
    JointType type;
    std::vector<Vec3> axes;
    double distance, angle;
  };
  // moved by 3 mm along z and 4 mm along x, turned by 0.3 rad about z, then by 0.02 rad about x
  const Quat bent = turnAbout(0.3, z) * turnAbout(0.02, x);
  const double all = 2 * std::acos(std::cos(0.15) * std::cos(0.01));  // of the whole turn
  for (const Case& one :
       {Case{JointType::kFixed, {}, 5e-3, all}, Case{JointType::kHinge, {z}, 5e-3, 0.02},
        Case{JointType::kSlider, {z}, 4e-3, all}, Case{JointType::kBall, {}, 5e-3, 0},
        Case{JointType::kUniversal, {z, x}, 5e-3, 0}, Case{JointType::kPrismaticRotary, {z, z}, 4e-3, 0.02}}) {
    const Scene scene = sceneWith(one.type, one.axes);
    JointMotion motion(scene);
    followJoints(motion, moved(scene, 3e-3 * z + 4e-3 * x, bent));
    const JointOpening opening = openingOf(scene.joints[0], motion.pose(0));
    EXPECT_NEAR(opening.distance, one.distance, 1e-12) << nameOf(one.type);
    EXPECT_NEAR(opening.angle, one.angle, 1e-7) << nameOf(one.type);
  }
  // a turn about the third direction of a universal joint is locked
  const Scene scene = sceneWith(JointType::kUniversal, {z, x});
  JointMotion motion(scene);
  followJoints(motion, moved(scene, Vec3::Zero(), turnAbout(0.05, Vec3::UnitY())));
  EXPECT_NEAR(openingOf(scene.joints[0], motion.pose(0)).angle, 0.05, 1e-12);
}

TEST(JointWords, SayWhatAJointIs) {
  Scene scene = sceneWith(JointType::kHinge, {Vec3::UnitZ()});
  Joint& joint = scene.joints[0];
  JointAxis& axis = joint.axes[0];
  axis.lower = 0, axis.upper = kPi / 2;
  axis.stiffness = 0.5, axis.rest = kPi / 6, axis.damping = 0.01, axis.friction = 0.02, axis.speed = 2,
  axis.max_force = 0.3;
  EXPECT_EQ(
      describeJoint(scene, joint),
      "hinge of part to frame about 0 0 1, from 0.0° to 90.0°, spring 0.5 N m/rad at rest at 30.0°, damping 0.01 N m "
      "s/rad, friction 0.02 N m, motor to 2 rad/s with up to 0.3 N m");
  scene.joints[0] = Joint{};
  joint.type = JointType::kSlider;
  joint.body = 1;
  joint.axes.resize(1);
  joint.axes[0].turns = false;
  joint.axes[0].upper = 0.12;
  joint.collide = true;
  EXPECT_EQ(describeJoint(scene, joint),
            "slider of part to the world along 0 0 1, up to 120.0 mm; the two collide with each other");
  EXPECT_EQ(positionText(joint, 0, -0.00002), "0.0 mm");
  EXPECT_EQ(positionText(joint, 0, -0.0123), "-12.3 mm");
}

}  // namespace
}  // namespace presa::scene_test
