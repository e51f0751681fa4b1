#include <gtest/gtest.h>
#include <cmath>
#include <numbers>

#include "framework/geometry/tri_mesh.h"
#include "modules/view_osg/camera.h"
#include "modules/view_osg/crease_normals.h"
#include "modules/view_osg/finger_view.h"
#include "tests/modules/view_osg/pinch_world.h"

namespace presa::view {
namespace {

FingerView pressing(const Vec3& nhat_W, double newton, std::int32_t body = 0) {
  FingerView finger;
  finger.mode = ContactMode::kStick;
  finger.body = body;
  finger.nhat_W = nhat_W;
  finger.normal_force = finger.commanded_normal = newton;
  return finger;
}

// Grip force counts only the normal forces that cancel on one body; a push moves the body instead.
TEST(Readings, GripForceIsWhatTheNormalsCancel) {
  const Vec3 x = Vec3::UnitX();
  EXPECT_DOUBLE_EQ(gripForce({pressing(x, 3), pressing(-x, 3)}), 3);
  EXPECT_DOUBLE_EQ(gripForce({pressing(x, 5), pressing(-x, 3)}), 3);  // 2 N accelerate the object
  EXPECT_DOUBLE_EQ(gripForce({pressing(x, 7)}), 0);
  EXPECT_DOUBLE_EQ(gripForce({pressing(x, 4), pressing(x, 4)}), 0);
  EXPECT_DOUBLE_EQ(gripForce({pressing(x, 4, 0), pressing(-x, 4, 1)}), 0);  // two objects, no grip
  EXPECT_DOUBLE_EQ(gripForce({}), 0);
}

// A magnet pulls a fingertip that touches nothing: the arrow begins at its centre. No arrow for no force or no number.
TEST(Readings, TheForceOfAnEffectHasAnArrowWithoutContact) {
  auto run = view_test::makePinchRun(RunOptions::View::kOffscreen, "");
  const auto states = view_test::makePinchStates(*run.world, {0, 0, 0.08});
  ViewFrame frame;
  frame.device = states.device;
  frame.contacts = states.contacts;
  FingerContact& contact = frame.contacts.fingers[0];
  contact.mode = ContactMode::kNone;
  contact.body = kNoBody;
  contact.f_H_W = {0, 2, 0};
  const FingerView pulled = fingerViews(*run.world, frame)[0];
  EXPECT_TRUE(pulled.isPushed());
  EXPECT_EQ(pulled.forceBegin(), contact.p_WP);
  EXPECT_EQ(pulled.forceEnd(), contact.p_WP + Vec3(0, 2 * kArrowLengthPerNewton, 0));
  EXPECT_FALSE(withoutMeasured({pulled})[0].isPushed());
  for (const double none : {0.0, std::nan("")}) {
    contact.f_H_W.setConstant(none);
    EXPECT_FALSE(fingerViews(*run.world, frame)[0].isPushed()) << none;
  }
}

// The display said "16.00 of 10 N": it compared what was rendered with what the devices can give.
TEST(Readings, GripForceIsThatOfTheDevicesAndNeverAboveTheirLimits) {
  auto run = view_test::makePinchRun(RunOptions::View::kOffscreen, "");
  const auto states = view_test::makePinchStates(*run.world, {0, 0, 0.08});
  ViewFrame frame;
  frame.device = states.device;
  frame.contacts = states.contacts;
  frame.X_WB = {Pose{}, Pose{{0, 0, 0.08}, Quat::Identity()}};
  for (FingerContact& contact : frame.contacts.fingers) contact.normal_force = 16;
  frame.forces = ForceCommand(2);
  for (std::size_t f = 0; f < 2; ++f) frame.forces.f_H_W[f] = 10 * frame.contacts.fingers[f].nhat_B;
  EXPECT_DOUBLE_EQ(gripForce(fingerViews(*run.world, frame)), 10);
  frame.forces = ForceCommand(2);
  EXPECT_DOUBLE_EQ(gripForce(fingerViews(*run.world, frame)), 0) << "after a fault";

  std::vector<DeviceRole> roles(2);
  roles[0].limits.force = 10;
  roles[1].limits.force = 5;
  EXPECT_DOUBLE_EQ(maxGripForce(roles), 5);
  roles.resize(5, roles[0]);
  for (DeviceRole& role : roles) role.limits.force = 10;
  EXPECT_DOUBLE_EQ(maxGripForce(roles), 25);
}

// Fingertips are placed relative to the body as drawn: when the cube has moved and rotated since the contact was
// computed, the proxy stays one fingertip radius off the touched point, along the rotated normal.
TEST(Readings, ProxyRidesOnTheBodyAsDrawn) {
  auto run = view_test::makePinchRun(RunOptions::View::kOffscreen, "");
  const auto states = view_test::makePinchStates(*run.world, {0, 0, 0.08});
  ViewFrame frame;
  frame.device = states.device;
  frame.contacts = states.contacts;
  const double turn = std::numbers::pi / 2;
  frame.X_WB = {Pose{}, Pose{{0.1, 0.2, 0.3}, Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ()))}};
  const std::vector<FingerView> fingers = fingerViews(*run.world, frame);
  ASSERT_EQ(fingers.size(), 2U);
  // the thumb is at -x of the cube, which a quarter turn moves to -y
  const Vec3 touched(0.1, 0.2 - view_test::kCubeEdge / 2, 0.304);
  EXPECT_LT((fingers[0].p_WC - touched).norm(), 1e-15);  // rounding
  EXPECT_LT((fingers[0].p_WP - (touched - 0.008 * Vec3::UnitY())).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(fingers[0].frictionUse(), 0.9 / (0.8 * 3.2));
  EXPECT_DOUBLE_EQ(fingers[1].frictionUse(), 1.0);  // slips on its dynamic cone: 1.8 / (0.6 * 3)
}

// Edges of a box are sharp: three normals at each corner, each along an axis.
TEST(Creases, BoxKeepsItsEdges) {
  const ShadedMesh mesh = shadeWithCreases(makeBox({0.1, 0.2, 0.3}), 40 * std::numbers::pi / 180);
  EXPECT_EQ(mesh.positions.size(), 24U);
  EXPECT_EQ(mesh.indices.size(), 36U);
  for (const auto& normal : mesh.normals) EXPECT_NEAR(normal.cwiseAbs().maxCoeff(), 1, 1e-6);  // float
}

// A sphere is smooth: one normal per vertex, along its radius. Angle-weighted normals deviate far less than the faces
// do (edge / radius is about 1/13, so a face deviates by up to 2.5 degrees).
TEST(Creases, SphereIsSmooth) {
  const TriMesh sphere = makeSphere(0.05);
  const ShadedMesh mesh = shadeWithCreases(sphere, 40 * std::numbers::pi / 180);
  ASSERT_EQ(mesh.positions.size(), sphere.vertices.size());
  for (std::size_t i = 0; i < mesh.normals.size(); ++i)
    EXPECT_GT(mesh.normals[i].dot(mesh.positions[i].normalized()), std::cos(0.5 * std::numbers::pi / 180));
}

/// Fractions of the picture's half width and half height to which a ball extends, measured by its tangent planes.
struct Share {
  double left, right, down, up;
};
Share shareOf(const Ball& ball, const CameraPose& pose, double aspect) {
  const Vec3 forward = (pose.target - pose.eye).normalized(), right = forward.cross(Vec3::UnitZ()).normalized();
  const Vec3 up = right.cross(forward), to = ball.center - pose.eye;
  const double slope = std::tan(kFieldOfView / 2 * std::numbers::pi / 180);
  const auto reach = [&](const Vec3& axis) {
    const double depth = to.dot(forward), aside = to.dot(axis);
    return std::tan(std::atan2(aside, depth) + std::asin(ball.radius / std::hypot(depth, aside))) / slope;
  };
  return {reach(-right) / aspect, reach(right) / aspect, reach(-up), reach(up)};
}

// At any scale everything lies inside the picture, and the camera looks from the front, right and above.
TEST(Framing, HoldsEveryBallAtAnyScale) {
  for (const double scale : {0.3, 1.0, 20.0}) {
    const std::vector<Ball> balls{{{0, 0, 0.1 * scale}, 0.06 * scale}, {{0.3 * scale, -0.1 * scale, 0}, 0.01 * scale}};
    const CameraPose pose = frameSubject(balls, 16.0 / 9, chooseHeading(balls));
    for (const Ball& ball : balls) {
      const Share share = shareOf(ball, pose, 16.0 / 9);
      EXPECT_LT(std::max({share.left, share.right, share.down, share.up}), 1);
    }
    EXPECT_GT(pose.eye.x(), pose.target.x());
    EXPECT_LT(pose.eye.y(), pose.target.y());
    EXPECT_GT(pose.eye.z(), pose.target.z());
  }
}

// A wide flat field, a tower and one ball each use the allowed fraction of the picture's width (52 %) or height (80 %)
// exactly, with equal margins left and right, above and below. Exact up to rounding.
TEST(Framing, FillsThePictureWithFieldsAndTowers) {
  const auto grid = [](const Vec3& half) {
    std::vector<Ball> balls;
    for (int i = 0; i < 27; ++i)
      balls.push_back(
          {Vec3(0.3, 0.2, 0) + Vec3((i % 3 - 1) * half.x(), (i / 3 % 3 - 1) * half.y(), (i / 9 - 1) * half.z()), 0.03});
    return balls;
  };
  for (const double aspect : {16.0 / 9, 1.0}) {
    for (const auto& balls : {grid({1, 0.5, 0}), grid({0.05, 0.05, 0.8}), grid({0, 0, 0})}) {
      Share max{-1, -1, -1, -1};
      const CameraPose pose = frameSubject(balls, aspect, chooseHeading(balls));
      for (const Ball& ball : balls) {
        const Share share = shareOf(ball, pose, aspect);
        max = {std::max(max.left, share.left), std::max(max.right, share.right), std::max(max.down, share.down),
               std::max(max.up, share.up)};
      }
      EXPECT_NEAR(max.left, max.right, 0.02);  // relative to the half width; exact where the width is limiting
      EXPECT_NEAR(std::max(max.right / 0.52, max.up / 0.80), 1, 1e-9);
      EXPECT_LE(std::max(max.left / 0.52, max.down / 0.80), 1 + 1e-9);
    }
  }
}

}  // namespace
}  // namespace presa::view
