#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/modules/haptics_proxy/module_fixture.h"
#include "tests/modules/haptics_proxy/renderer_scene.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/rendered_body.h"

namespace presa {
namespace {

using test::kR;
using test::kStiffness;
using test::RenderedBody;

std::string settings(const std::string& attributes) {
  return "<haptics renderer=\"intermediate\"><intermediate " + attributes + "/></haptics>";
}

constexpr double kRadius = 0.05, kDepth = 0.002;  // of the ball and below it [m]

/// Largest error of the normal force of a finger that circles a ball of 50 mm at `speed`, 2 mm deep, in N; only whole
/// hand-overs, after the first.
double errorAroundBall(const std::string& attributes, double speed) {
  RenderedBody ball(settings(attributes), "<sphere radius=\"0.05\"/>");
  double worst = 0;
  const double held = kRadius + kR, turn = speed * 1e-3 / kRadius;
  for (int i = 0; i < 2000; ++i) {
    const double deep = i < 100 ? -0.001 + kDepth / 50 * std::min(i, 75) : kDepth;
    const Vec3 out(std::sin(turn * i), 0, std::cos(turn * i));
    const Vec3 force = ball.force((held - deep) * out);
    if (i > 200) worst = std::max(worst, std::abs(force.norm() - kStiffness * kDepth));
  }
  return worst;
}

// A plane that the finger left by the angle a is (R + r - depth) (1 - cos a) too far out, some (v T)^2 / (2 R). a is the way
// since the hand-over and what the new plane lags behind then: it touches the ball below the proxy, which the old plane
// let slide ahead by less than the finger.
TEST(Intermediate, PlaneIsWrongByTheSquareOfItsAge) {
  constexpr double kSpeed = 0.1, kHeld = kRadius + kR;
  double last = 0;
  for (const int every : {10, 20, 40}) {
    const double tick = kSpeed * 1e-3 / kRadius;
    double lag = 0;
    for (int i = 0; i < 100; ++i) {
      const double angle = every * tick + lag;
      lag = angle - std::atan((kHeld - kDepth) * std::sin(angle) / kHeld);
    }
    const double oracle = kStiffness * (kHeld - kDepth) * (1 - std::cos((every - 1) * tick + lag));
    const double error = errorAroundBall("every=\"" + std::to_string(every) + "\" blend=\"0\"", kSpeed);
    EXPECT_NEAR(error / oracle, 1, 0.01) << every;
    if (last > 0) {
      EXPECT_NEAR(error / last, 4, 0.5) << every;
    }
    last = error;
  }
}

TEST(Intermediate, SphereFollowsABall) {
  EXPECT_LT(errorAroundBall("every=\"40\" blend=\"0\" sphere=\"true\"", 0.1),
            1e-3 * errorAroundBall("every=\"40\" blend=\"0\"", 0.1));
}

/// Largest change of the force in a tick, of a finger that is dragged around the ball.
double largestStep(const std::string& attributes) {
  RenderedBody ball(settings(attributes), "<sphere radius=\"0.05\"/>");
  Vec3 last = Vec3::Zero();
  double step = 0;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 0.3 * 1e-3 * i / kRadius, depth = kDepth * std::min(1.0, i / 100.0);
    const Vec3 force = ball.force((kRadius + kR - depth) * Vec3(std::sin(angle), 0, std::cos(angle)));
    if (i > 150) step = std::max(step, (force - last).norm());
    last = force;
  }
  return step;
}

// 0.3 m/s, 20 ms old: the plane is 0.42 mm off at the hand-over, 0.42 N. Faded in over 10 ticks, no step exceeds a
// tenth of that by much more than the finger's own motion; 1 N a tick is the slew limit.
TEST(Intermediate, FadesANewSurfaceInWithoutAStep) {
  EXPECT_GT(largestStep("every=\"20\" blend=\"0\""), 0.3);
  EXPECT_LT(largestStep("every=\"20\" blend=\"10\""), 0.15);
}

// A proxy that stays on its side: a plate of 1 mm, pressed 5 mm deep, while the plane is new every 10 ms.
TEST(Intermediate, StaysOnItsSideOfAThinPlate) {
  RenderedBody plate(settings("every=\"10\""), "<box size=\"0.1 0.1 0.001\"/>");
  Vec3 force = Vec3::Zero();
  for (int i = 0; i < 500; ++i) force = plate.force({1e-5 * i, 0, 0.02 - std::min(0.0165, 1e-4 * i)});
  EXPECT_NEAR(force.z(), kStiffness * (0.0005 + kR - 0.0035), 1e-9);
}

TEST(Intermediate, NeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  RenderedBody ball(settings("sphere=\"true\""), "<sphere radius=\"0.05\"/>");
  const RealTimeGuard guard;
  for (int i = 0; i < 100; ++i) ball.force({1e-4 * i, 0, 0.056});
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

TEST(SceneWithIntermediate, LoadsItAndNotTheGodObject) { test::expectOwnRenderer("intermediate"); }

}  // namespace
}  // namespace presa
