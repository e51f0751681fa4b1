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

// The line lies so that the body swings its top up: level, and square to where the top points now.
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

TEST(Grasp, OfAFlatBodyOnItsHeadIsAtItsSideToLayItDown) {
  World world = block();
  world.scene.bodies[0].physics = Geometry{Box{{0.08, 0.04, 0.03}}, {}, {}};
  const Grasp grasp = chooseGrasp(world, 0, {{0, 0, 0.015}, turn(EIGEN_PI, Vec3::UnitX())}, {}, 0);
  EXPECT_TRUE(grasp.lays_down);
  EXPECT_NEAR(std::abs(grasp.p_BC.x()), 0.75 * 0.04, 1e-12) << "square to the line between the fingers";
  EXPECT_NEAR(grasp.rise, 0.04 - 0.015, 1e-12);
}

}  // namespace
}  // namespace presa::assembling
