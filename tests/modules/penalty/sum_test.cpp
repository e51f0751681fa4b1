// What adding up the forces of all bodies gets wrong, against the exact contact of the god-object.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/modules/haptics_proxy/module_fixture.h"

namespace presa::penalty_sum {
namespace {

using test::kR;
using test::kStiffness;

World boxes(const std::vector<Pose>& poses, const std::string& renderer) {
  World world = test::worldOf(Box{{1, 1, 1}});
  world.scene.bodies.resize(poses.size(), world.scene.bodies[0]);
  world.meshes.resize(poses.size());
  world.inertias.resize(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i)
    world.scene.bodies[i].X_WB = poses[i] * Pose{{0, 0, -0.5}, Quat::Identity()};
  world.scene.haptics.renderer = renderer;
  world.scene.haptics.proxy = renderer == "god_object";
  if (renderer != "penalty") return world;
  PluginElement settings{"penalty", "penalty", kNoBody, {{"sum", "true"}}, {}};
  settings.kind = PluginKind::kRenderer;
  world.scene.plugin_elements.push_back(settings);
  return world;
}

Vec3 forceAt(const Vec3& p, const std::vector<Pose>& poses, const std::string& renderer) {
  test::OneFinger finger(boxes(poses, renderer));
  finger.tick({0, 0, 0.05});
  return finger.tick(p).f_H_W;
}

// A groove of two walls whose normals differ by phi; the finger is 1 mm deep in both. Oracle: |sum| / |exact| = 1 + cos phi.
TEST(PenaltySum, IsOnePlusCosineOfTheAngleBetweenTwoWallsTimesTheExactForce) {
  for (const double degrees : {20.0, 60.0, 90.0, 120.0, 150.0}) {
    const double phi = degrees * std::numbers::pi / 180;
    const std::vector<Pose> walls{{Vec3::Zero(), Quat(Eigen::AngleAxisd(phi / 2, Vec3::UnitY()))},
                                  {Vec3::Zero(), Quat(Eigen::AngleAxisd(-phi / 2, Vec3::UnitY()))}};
    const Vec3 p(0, 0, (kR - 0.001) / std::cos(phi / 2));
    const Vec3 sum = forceAt(p, walls, "penalty"), exact = forceAt(p, walls, "god_object");
    EXPECT_NEAR(exact.z(), kStiffness * 0.001 / std::cos(phi / 2), 1e-6) << degrees;
    EXPECT_NEAR(sum.norm() / exact.norm(), 1 + std::cos(phi), 1e-5) << degrees;
  }
}

// Two boards side by side, and a finger over both.
TEST(PenaltySum, DoublesTheForceWhereTwoBodiesShareASide) {
  const std::vector<Pose> boards{{Vec3(0.3, 0, 0), Quat::Identity()}, {Vec3(-0.3, 0, 0), Quat::Identity()}};
  EXPECT_NEAR(forceAt({0, 0, kR - 0.001}, boards, "god_object").z(), kStiffness * 0.001, 1e-6);
  EXPECT_NEAR(forceAt({0, 0, kR - 0.001}, boards, "penalty").z(), 2 * kStiffness * 0.001, 1e-6);
}

TEST(PenaltySum, OfOneBodyIsItsForce) {
  const std::vector<Pose> board{{Vec3::Zero(), Quat::Identity()}};
  EXPECT_NEAR(forceAt({0, 0, kR - 0.001}, board, "penalty").z(), kStiffness * 0.001, 1e-6);
}

}  // namespace
}  // namespace presa::penalty_sum
