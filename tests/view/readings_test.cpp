#include <gtest/gtest.h>
#include <cmath>
#include <numbers>

#include "framework/geometry/tri_mesh.h"
#include "modules/view_osg/camera.h"
#include "modules/view_osg/crease_normals.h"
#include "modules/view_osg/finger_view.h"
#include "tests/view/pinch_world.h"

namespace presa::view {
namespace {

FingerView pressing(const Vec3& nhat_W, double newton, std::int32_t body = 0) {
  FingerView finger;
  finger.mode = ContactMode::kStick;
  finger.body = body;
  finger.nhat_W = nhat_W;
  finger.normal_force = newton;
  return finger;
}

// A grip squeezes; a push moves. Only what the normal forces cancel on one body counts.
TEST(Readings, GripForceIsWhatTheNormalsCancel) {
  const Vec3 x = Vec3::UnitX();
  EXPECT_DOUBLE_EQ(gripForce({pressing(x, 3), pressing(-x, 3)}), 3);
  EXPECT_DOUBLE_EQ(gripForce({pressing(x, 5), pressing(-x, 3)}), 3);  // 2 N accelerate the object
  EXPECT_DOUBLE_EQ(gripForce({pressing(x, 7)}), 0);
  EXPECT_DOUBLE_EQ(gripForce({pressing(x, 4), pressing(x, 4)}), 0);
  EXPECT_DOUBLE_EQ(gripForce({pressing(x, 4, 0), pressing(-x, 4, 1)}), 0);  // two objects, no grip
  EXPECT_DOUBLE_EQ(gripForce({}), 0);
}

// Fingertips ride on the body as drawn: with the cube moved and turned after the contact was found, the proxy stays one
// fingertip radius off the touched point, along the turned normal.
TEST(Readings, ProxyRidesOnTheBodyAsDrawn) {
  const auto world = view_test::makePinchWorld(RunOptions::View::kOffscreen, "");
  const auto states = view_test::makePinchStates(*world, {0, 0, 0.08});
  ViewFrame frame;
  frame.device = states.device;
  frame.contacts = states.contacts;
  const double turn = std::numbers::pi / 2;
  frame.X_WB = {Pose{}, Pose{{0.1, 0.2, 0.3}, Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ()))}};
  const std::vector<FingerView> fingers = fingerViews(*world, frame);
  ASSERT_EQ(fingers.size(), 2U);
  // thumb: at -x of the cube, which a quarter turn brings to -y
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

// A sphere is round: one normal per vertex, along its radius. Angle-weighted normals of this subdivision lean by far less
// than its faces do (edge / radius is about 1/13, so a face leans by up to 2.5 degrees).
TEST(Creases, SphereIsSmooth) {
  const TriMesh sphere = makeSphere(0.05);
  const ShadedMesh mesh = shadeWithCreases(sphere, 40 * std::numbers::pi / 180);
  ASSERT_EQ(mesh.positions.size(), sphere.vertices.size());
  for (std::size_t i = 0; i < mesh.normals.size(); ++i)
    EXPECT_GT(mesh.normals[i].dot(mesh.positions[i].normalized()), std::cos(0.5 * std::numbers::pi / 180));
}

// Whatever the scene's size, everything lies inside the viewing cone, and the camera looks from the front, right and above.
TEST(Framing, HoldsEveryBallAtAnyScale) {
  for (const double scale : {0.3, 1.0, 20.0}) {
    const std::vector<Ball> balls{{{0, 0, 0.1 * scale}, 0.06 * scale}, {{0.3 * scale, -0.1 * scale, 0}, 0.01 * scale}};
    const CameraPose pose = frameSubject(balls, 16.0 / 9, chooseHeading(balls));
    const Vec3 forward = (pose.target - pose.eye).normalized();
    for (const Ball& ball : balls) {
      const Vec3 to_ball = ball.center - pose.eye;
      const double off_axis = std::acos(to_ball.normalized().dot(forward)) + std::asin(ball.radius / to_ball.norm());
      EXPECT_LT(off_axis, kFieldOfView / 2 * std::numbers::pi / 180);
    }
    EXPECT_GT(pose.eye.x(), pose.target.x());
    EXPECT_LT(pose.eye.y(), pose.target.y());
    EXPECT_GT(pose.eye.z(), pose.target.z());
  }
}

}  // namespace
}  // namespace presa::view
