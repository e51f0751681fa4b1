#include <gtest/gtest.h>

#include <cmath>

#include "framework/core/math/random.h"
#include "tests/modules/haptics_proxy/module_fixture.h"
#include "tests/modules/haptics_proxy/renderer_scene.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/rendered_body.h"

namespace presa {
namespace {

using test::kR;
using test::kStiffness;

const std::string kNewer = "<haptics renderer=\"scp\"/>";
const std::string kOlder = R"(<haptics renderer="scp"><scp older="true"/></haptics>)";

// A finger wanders over a box at the speed of a hand, in and out, over edges and corners. Where one straight motion a tick
// suffices the surface point is the god-object; around an edge, which the god-object rounds at once, it needs some ticks, in which the
// device may change its mind.
TEST(Scp, FollowsTheGodObjectOverABox) {
  for (const std::string& form : {kNewer, kOlder}) {
    test::RenderedBody scp(form, "<box size=\"0.06 0.05 0.04\"/>"), exact("", "<box size=\"0.06 0.05 0.04\"/>");
    RandomStream random(1, "box", 0);
    Vec3 p(0, 0, 0.05), goal = p;
    int touching = 0, late = 0;
    for (int i = 0; i < 20'000; ++i) {
      if (i % 100 == 0)
        goal = Vec3(random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), random.uniform(-0.04, 0.04));
      if (p != goal) p += (goal - p).normalized() * std::min(3e-4, (goal - p).norm());
      const Vec3 force = scp.force(p), expected = exact.force(p);
      if (expected.isZero(0)) continue;
      ++touching;
      late += (force - expected).norm() < 1e-6 ? 0 : 1;
    }
    EXPECT_GT(touching, 5000);
    EXPECT_LT(static_cast<double>(late) / touching, 0.05);
  }
}

/// A floor at z = 0 and a block that stands on it from x = 0 to 50 mm.
World floorAndBlock(bool older) {
  World world = test::worldOf(Box{{1, 1, 0.2}});
  world.scene.bodies.resize(2, world.scene.bodies[0]);
  world.meshes.resize(2);
  world.inertias.resize(2);
  world.scene.bodies[0].X_WB.p = Vec3(0, 0, -0.1);
  world.scene.bodies[1].X_WB.p = Vec3(0.025, 0, 0.025);
  world.scene.bodies[1].haptic->shape = Box{{0.05, 1, 0.05}};
  world.scene.haptics.renderer = "scp";
  PluginElement settings{"scp", "scp", kNoBody, {{"older", older ? "true" : "false"}}, {}};
  settings.kind = PluginKind::kRenderer;
  world.scene.plugin_elements.push_back(settings);
  return world;
}

// The two printed forms test different segments. The device dives 200 mm under the floor under a block: the slide along
// the floor meets the block, the way to the device does not.
TEST(Scp, OlderFormSlidesIntoABlockThatTheWayToTheDeviceDoesNotMeet) {
  for (const bool older : {false, true}) {
    test::OneFinger finger(floorAndBlock(older));
    finger.tick({-0.02, 0, 0.02});
    finger.tick({-0.02, 0, kR - 0.2});
    const FingerContact contact = finger.tick({0.02, 0, kR - 0.2});
    EXPECT_NEAR(contact.p_WP.x(), older ? 0.02 : -kR, 1e-9) << older;
    EXPECT_EQ(finger.all().pop_through, older ? 1u : 0u);
  }
}

// In the corner of two walls and a floor: k (x - g), exactly.
TEST(Scp, ThreeWallsHoldThePointInTheirCorner) {
  World world = test::worldOf(Box{{1, 1, 1}});
  world.scene.bodies.resize(3, world.scene.bodies[0]);
  world.meshes.resize(3);
  world.inertias.resize(3);
  for (int axis = 0; axis < 3; ++axis) world.scene.bodies[static_cast<std::size_t>(axis)].X_WB.p[axis] = -0.5;
  world.scene.haptics.renderer = "scp";
  test::OneFinger finger(std::move(world));
  finger.tick({0.02, 0.02, 0.02});
  const FingerContact contact = finger.tick({0.001, 0.002, 0.003});
  EXPECT_NEAR((contact.f_H_W - kStiffness * Vec3(kR - 0.001, kR - 0.002, kR - 0.003)).norm(), 0, 1e-6);
}

TEST(Scp, NeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  test::RenderedBody ball(kNewer, "<sphere radius=\"0.05\"/>");
  const RealTimeGuard guard;
  for (int i = 0; i < 100; ++i) ball.force({1e-4 * i, 0, 0.056});
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

TEST(SceneWithScp, LoadsItAndNotTheGodObject) { test::expectOwnRenderer("scp"); }

}  // namespace
}  // namespace presa
