#include "devices/assembling_hand/grasp.h"

#include <gtest/gtest.h>

namespace presa::assembling {
namespace {

Quat turn(double angle, const Vec3& axis) { return Quat(Eigen::AngleAxisd(angle, axis.normalized())); }

/// A block of 80 x 40 x 60 mm and 0.1 kg, friction 0.5.
World block() {
  World world;
  world.scene.materials.emplace_back().friction_static = 0.5;
  world.scene.materials[0].friction_dynamic = 0.5;
  world.scene.bodies.emplace_back().physics = Geometry{Box{{0.08, 0.04, 0.06}}, {}, {}};
  world.meshes.resize(1);
  world.inertias = {{0.1, Vec3::Zero(), Mat3::Identity()}};
  return world;
}

/// The best grasp with which the body hangs upright.
Grasp chooseGrasp(const World& world, std::size_t i, const Pose& X_WB, const Pose& X_WG, double yaw) {
  const Vec3 up_B = X_WG.q.conjugate() * Vec3::UnitZ();
  const Lines lines = linesToHang(world, i, X_WB, up_B, yaw);
  EXPECT_GE(lines.count, 1U);
  return graspAlong(world, i, X_WB, up_B, lines.a_W[0], yaw);
}

TEST(HalfWidth, IsTheSupportOfTheShape) {
  EXPECT_NEAR(halfWidth(Box{{2, 4, 6}}, nullptr, Vec3::UnitY()), 2, 1e-15);
  EXPECT_NEAR(halfWidth(Box{{2, 2, 2}}, nullptr, Vec3(1, 1, 0).normalized()), std::sqrt(2), 1e-12);
  EXPECT_NEAR(halfWidth(Cylinder{0.3, 2}, nullptr, Vec3::UnitZ()), 1, 1e-15);
  EXPECT_NEAR(halfWidth(Cylinder{0.3, 2}, nullptr, Vec3::UnitX()), 0.3, 1e-15);
  EXPECT_NEAR(halfWidth(Sphere{0.3}, nullptr, Vec3(1, 2, 3).normalized()), 0.3, 1e-15);
}

TEST(Grasp, OfAStandingBodyIsAcrossItsNarrowSideAndAboveItsCentre) {
  const Grasp grasp = chooseGrasp(block(), 0, {{0.3, 0, 0.03}, turn(0.4, Vec3::UnitZ())}, {}, 0);
  EXPECT_NEAR(grasp.half, 0.02, 1e-12);
  EXPECT_NEAR(std::abs(grasp.a_B.y()), 1, 1e-12);
  EXPECT_NEAR(grasp.p_BC.z(), 0.75 * 0.03, 1e-12);
  EXPECT_NEAR(grasp.force, 2.5 * 0.1 * 9.81 / (2 * 0.5), 1e-12);
}

// For a body to swing its top up, the line is level and perpendicular to the current direction of the top.
TEST(Grasp, OfALyingBodyIsLevelAndNearItsTop) {
  const Pose lies{{0, 0, 0.04}, turn(EIGEN_PI / 2, Vec3::UnitY())};  // its z points along x
  const Grasp grasp = chooseGrasp(block(), 0, lies, {}, 1);
  const Vec3 a_W = lies.q * grasp.a_B;
  EXPECT_NEAR(a_W.z(), 0, 1e-12);
  EXPECT_NEAR(a_W.dot(lies.q * Vec3::UnitZ()), 0, 1e-12);
  EXPECT_NEAR(grasp.p_BC.z(), 0.75 * 0.03, 1e-12);
}

TEST(Grasp, OfABodyOnItsHeadIsBelowItsCentre) {
  const Pose on_its_head{{0, 0, 0.03}, turn(EIGEN_PI, Vec3::UnitX())};
  const Grasp grasp = chooseGrasp(block(), 0, on_its_head, {}, 0);
  EXPECT_NEAR((on_its_head * grasp.p_BC).z(), 0.03 - 0.75 * 0.03, 1e-12);
}

// A wedge is lower above its middle than at its high end: a grasp based on its overall height would miss it.
TEST(Grasp, OfAWedgeIsWithinIt) {
  World world = block();
  world.scene.bodies[0].physics = Geometry{MeshRef{}, {}, {}};
  auto wedge = std::make_shared<TriMesh>();
  wedge->vertices = {{-0.03, -0.01, -0.01}, {0.03, -0.01, -0.01}, {0.03, 0.01, -0.01},
                     {-0.03, 0.01, -0.01},  {0.03, -0.01, 0.02},  {0.03, 0.01, 0.02}};
  wedge->triangles = {{0, 4, 5}, {0, 5, 3}, {0, 2, 1}, {0, 3, 2}, {1, 5, 4}, {1, 2, 5}, {0, 1, 4}, {3, 5, 2}};
  world.meshes[0].physics = wedge;
  // the slope rises from -10 mm by one half: it is 5 mm above the middle
  EXPECT_NEAR(outTo(world, 0, Vec3::UnitZ()), 0.005, 1e-12);
  EXPECT_NEAR(outTo(world, 0, -Vec3::UnitZ()), 0.01, 1e-12);
  EXPECT_NEAR(outTo(block(), 0, Vec3::UnitZ()), 0.03, 1e-12);
  const double lean = 0.2;  // of a box's top, as on a roof
  EXPECT_NEAR(outTo(block(), 0, {std::sin(lean), 0, std::cos(lean)}), 0.03 / std::cos(lean), 1e-12);
}

}  // namespace
}  // namespace presa::assembling
