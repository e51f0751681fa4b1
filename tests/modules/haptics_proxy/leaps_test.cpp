// Where a surface no longer holds a finger, the finger moves on to the next place that does, and the tick is counted as
// a leap.
#include <gtest/gtest.h>

#include "tests/modules/haptics_proxy/module_fixture.h"

namespace presa {
namespace {

constexpr double kTip = 0.001, kStep = 0.003;

World touched(const Shape& shape, double mu) {
  World world = test::worldOf(shape, false);
  world.scene.materials[0].friction_static = world.scene.materials[0].friction_dynamic = mu;
  world.scene.devices[0].fingertip_radius = kTip;
  return world;
}

/// Two treads of a stair: the upper one at x < 0, kStep above the lower one.
World stair(double mu) {
  World world = touched(Box{{1, 1, 1}}, mu);
  world.scene.bodies.clear();
  world.meshes.clear();
  world.inertias.clear();
  const Vec3 size(0.1, 0.1, 0.1);
  for (const Vec3& p : {Vec3(-0.05, 0, -0.05 + kStep), Vec3(0.05, 0, -0.05)}) {
    Body body;
    body.name = "tread" + std::to_string(world.scene.bodies.size());
    body.X_WB.p = p;
    body.haptic = Geometry{MeshRef{}, {}, {}};
    world.scene.bodies.push_back(body);
    world.meshes.emplace_back().haptic = std::make_shared<const TriMesh>(makeBox(size));
    world.inertias.emplace_back();
  }
  return world;
}

/// Presses to `depth` below the lower tread and walks from x = -10 mm to 10 mm.
struct Walk {
  std::uint32_t leaps = 0;
  double farthest = 0;  ///< largest motion of the proxy in a tick [m]
};
Walk walk(double depth, double mu) {
  test::OneFinger finger(stair(mu));
  const double low = kTip - depth, high = kStep + kTip + 0.001;
  for (int i = 0; i <= 200; ++i) finger.tick({-0.01, 0, high + (low - high) * i / 200.0});
  Walk walk;
  Vec3 last = finger.all().fingers[0].p_WP;
  for (int i = 0; i <= 200; ++i) {
    const Vec3 p_WP = finger.tick({-0.01 + 1e-4 * i, 0, low}).p_WP;
    walk.farthest = std::max(walk.farthest, (p_WP - last).norm());
    last = p_WP;
  }
  walk.leaps = finger.all().leaps_by_finger[0];
  EXPECT_EQ(finger.all().pop_through, 0u);
  EXPECT_NEAR(last.z(), kTip, 1e-6);  // finally it rests on the lower tread
  return walk;
}

// 5 mm below the edge of the upper tread the fingertip comes round the edge and has no support until the lower tread:
// it moves down by about the height of the step within a tick or two.
TEST(Leaps, ComingDownAStairIsCounted) {
  for (const double mu : {0.0, 0.4}) {
    const Walk deep = walk(0.002, mu);
    EXPECT_GE(deep.leaps, 1u) << mu;
    EXPECT_LE(deep.leaps, 3u) << mu;
    EXPECT_GT(deep.farthest, 0.2 * kStep) << mu;
  }
}

// A flat surface and a sphere hold the finger continuously, with and without friction: no leaps.
TEST(Leaps, SlidingIsNone) {
  for (const double mu : {0.0, 0.4}) {
    test::OneFinger flat(stair(mu));
    for (int i = 0; i <= 300; ++i) flat.tick({0.002 + 1e-4 * i, 0, kTip + 0.001 - 2e-5 * std::min(i, 100)});
    EXPECT_EQ(flat.all().leaps_by_finger[0], 0u) << mu;

    test::OneFinger round(touched(Sphere{0.03}, mu));
    for (int i = 0; i <= 600; ++i) {
      const double angle = 2e-3 * i, distance = 0.03 + kTip + 0.001 - 1e-5 * std::min(i, 300);
      round.tick(distance * Vec3(std::cos(angle), std::sin(angle), 0));
    }
    EXPECT_EQ(round.all().leaps_by_finger[0], 0u) << mu;
  }
}

}  // namespace
}  // namespace presa
