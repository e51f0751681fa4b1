// A material by an image: its stiffness and friction from place to place, and no energy from a closed loop.
#include <gtest/gtest.h>

#include "tests/modules/texture_image/image_fixture.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/lockstep_run.h"

namespace presa {
namespace {

using test::kPlace, test::kR, test::kStiffness, test::kTurn, test::OnSide, test::pngOf;

constexpr double kWidth = 0.02;  // of a tile [m]

/// The cube of the texture tests, its material by the image.
World cube(const std::string& file, double stiffness, double friction) {
  World world = test::imageCube({file, kWidth, 0, 0});
  PluginElement& element = world.scene.plugin_elements[0];
  element.element = "material_image";
  element.attributes["stiffness"] = std::to_string(stiffness);
  element.attributes["friction"] = std::to_string(friction);
  if (friction < 1) {
    world.scene.materials[0].friction_static = 0.6;
    world.scene.materials[0].friction_dynamic = 0.4;
  }
  return world;
}

/// 16 by 16 pixels; the left half of a tile is black, the right one white.
std::string halves() {
  return pngOf("halves.png", 16, 16, 8, [](unsigned x, unsigned) { return x < 8 ? 0 : 1; });
}

// Two pixels from a border the spline is flat: the places below are three away. x is counted from the middle of the
// side, where a tile begins.
TEST(MaterialImage, HasItsStiffnessWhereItIsBlack) {
  OnSide finger(cube(halves(), 0.5, 1), 2);
  for (const double depth : {0.0005, 0.002, 0.004}) {
    const double most = 2 * kPlace * kStiffness;
    EXPECT_NEAR(finger.force(0.005, 0.001, depth).z(), 0.5 * kStiffness * depth, most);
    EXPECT_NEAR(finger.force(-0.005, 0.001, depth).z(), kStiffness * depth, most);
    EXPECT_NEAR(finger.force(0.015, 0.001, depth).z(), kStiffness * depth, most);
    // halfway between the two, in the middle of the border
    EXPECT_NEAR(finger.force(0.010, 0.001, depth).dot(Vec3::UnitZ()), 0.75 * kStiffness * depth, 2 * most);
  }
}

// The force at a border, E = k d^2 / 2 by differences of the energy.
TEST(MaterialImage, PushesTowardsTheSofterSide) {
  OnSide finger(cube(halves(), 0.5, 1), 2);
  constexpr double kDepth = 0.003, kStep = 1e-5;
  const auto energy = [&](double x) { return 0.5 * kDepth * finger.force(x, 0.001, kDepth).z(); };
  for (const double x : {0.0092, 0.0096, 0.010, 0.0104, 0.0108}) {
    const double slope = (energy(x + kStep) - energy(x - kStep)) / (2 * kStep);
    // E''' h^2 / 6, with k''' <= 0.6 kStiffness / pixel^3; the proxy ends within kPlace of its place, in force and energy
    const double pixel = kWidth / 16,
                 most = 0.05 * kStiffness * kDepth * kDepth * kStep * kStep / (pixel * pixel * pixel) +
                        kStiffness * kDepth * kPlace / kStep + kStiffness * kPlace;
    const double pushed = finger.force(x, 0.001, kDepth).x();
    EXPECT_NEAR(pushed, -slope, most) << x;
    EXPECT_LT(pushed, -0.1) << x;  // black lies to the left
  }
}

// As over a texture (force_test.cpp): the trapezoidal rule, whose error falls by four when the step is halved.
TEST(ALoopOverAMaterialImage, GainsNoEnergy) {
  RandomStream random(5, "pixels");
  const std::string file = pngOf("rough_material.png", 8, 8, 8, [&](unsigned, unsigned) { return random.uniform(); });
  for (const bool leaves : {false, true}) {
    std::vector<double> share;
    for (const int steps : {1500, 3000}) {
      OnSide finger(cube(file, 0.5, 1), 3);
      const auto [net, moved] = test::workRound(finger, leaves, steps);
      share.push_back(std::abs(net) / moved);
    }
    // 25 mm in 1500 steps of 17 um: 150 a pixel of 2.5 mm
    EXPECT_LT(share[0], std::pow(kTurn / 300, 2) / 12) << leaves;
    EXPECT_LT(share[1], std::max(share[0] / 2, 4e-5)) << leaves;
  }
}

/// Largest and smallest tangential over normal force while the finger slides along x from `from` to `to`.
std::pair<double, double> slidingRatio(const World& world, double from, double to) {
  test::OneFinger finger(world);
  const Pose X_WT = world.scene.bodies[0].X_WB * tangentFrame(Vec3::UnitZ(), test::kHalf * Vec3::UnitZ());
  finger.tick(X_WT * Vec3(from, 0.001, kR + 0.001));
  std::pair<double, double> ratio{1e9, 0};
  constexpr int kTicks = 400;
  for (int i = 0; i <= kTicks; ++i) {
    const FingerContact& contact = finger.tick(X_WT * Vec3(from + (to - from) * i / kTicks, 0.001, kR - 0.001));
    if (i < kTicks / 2) continue;  // it has broken away
    EXPECT_TRUE(contact.mode == ContactMode::kSlip) << i;
    const double now = contact.tangential_force_W.norm() / contact.normal_force;
    ratio = {std::min(ratio.first, now), std::max(ratio.second, now)};
  }
  return ratio;
}

TEST(MaterialImage, SlidesByItsOwnFrictionOnEachSide) {
  const World world = cube(halves(), 0.5, 0.25);
  const auto black = slidingRatio(world, 0.003, 0.007), white = slidingRatio(world, -0.003, -0.007);
  EXPECT_NEAR(black.first, 0.25 * 0.4, 0.005 * 0.1);
  EXPECT_NEAR(black.second, 0.25 * 0.4, 0.005 * 0.1);
  EXPECT_NEAR(white.first, 0.4, 0.005 * 0.4);
  EXPECT_NEAR(white.second, 0.4, 0.005 * 0.4);
}

TEST(MaterialImage, BreaksAwayAtItsOwnFrictionOnEachSide) {
  const World world = cube(halves(), 1, 0.25);
  for (const auto& [x, mu] : {std::pair(0.005, 0.25 * 0.6), {-0.005, 0.6}}) {
    test::OneFinger finger(world);
    const Pose X_WT = world.scene.bodies[0].X_WB * tangentFrame(Vec3::UnitZ(), test::kHalf * Vec3::UnitZ());
    finger.tick(X_WT * Vec3(x, 0, kR + 0.001));
    constexpr double kDepth = 0.001, kStep = 1e-7;
    double held = 0;
    for (double way = 0; way < kDepth; way += kStep) {
      const FingerContact& contact = finger.tick(X_WT * Vec3(x, way, kR - kDepth));
      if (contact.mode == ContactMode::kSlip) break;
      held = contact.tangential_force_W.norm() / contact.normal_force;
    }
    EXPECT_NEAR(held, mu, 0.005 * mu) << x;
  }
}

TEST(MaterialImage, NeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  OnSide finger(cube(halves(), 0.5, 0.25), 2);
  finger.force(0, 0, 0.001);
  const RealTimeGuard guard;
  for (int i = 0; i < 200; ++i) finger.force(1e-4 * i, 0, 1e-5 * i);
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

TEST(SceneWithMaterialImage, IsExplainedOnlyWhereItIsNamed) {
  const test::Outcome plain = test::presa("explain " + test::source("config/scenes/texture_image.xml"));
  EXPECT_EQ(plain.out.find("material by image"), std::string::npos) << plain.out;
  EXPECT_EQ(plain.out.find("from place to place"), std::string::npos) << plain.out;
  const test::Outcome there = test::presa("explain " + test::source("config/scenes/material_image.xml"));
  EXPECT_EQ(there.status, 0) << there.err;
  EXPECT_NE(there.out.find("friction: friction_cone; from place to place, as the surface effects say"),
            std::string::npos)
      << there.out;
  EXPECT_NE(there.out.find("material by image pads.png, black: 40 % of the stiffness, 20 % of the friction; tiles of "
                           "40 mm by 40 mm"),
            std::string::npos)
      << there.out;
}

TEST(SceneWithMaterialImage, IsStrokedToTheEndOfTheScript) {
  const test::LockstepRun run(test::source("config/scenes/material_image.xml"));
  EXPECT_TRUE(run.faults().empty()) << run.faults().front();
  EXPECT_GT(run.maxNormalForce("index"), 1);
}

TEST(BadMaterialImage, TooSteepIsRefusedWithItsPlace) {
  pngOf("stripes.png", 16, 1, 8, [](unsigned x, unsigned) { return x % 2; });
  const std::string scene = test::cubeWith("patched.xml", [&](std::string& xml) {
    xml.insert(xml.find("<friction "), R"(<material_image file="stripes.png" width="0.004" stiffness="0.2"/>)");
  });
  const test::Outcome steep = test::withTestPlugins("run", scene, " --lockstep --view none");
  EXPECT_EQ(steep.status, 2);
  EXPECT_NE(steep.err.find("patched.xml:8:80: error[E596]"), std::string::npos) << steep.err;
  EXPECT_NE(steep.err.find("the stiffness changes too steeply"), std::string::npos) << steep.err;
}

}  // namespace
}  // namespace presa
