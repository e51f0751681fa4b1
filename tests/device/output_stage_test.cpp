#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "framework/device/output_stage.h"

namespace presa {
namespace {

constexpr OutputLimits kLimits{.force = 8, .force_rate = 1000, .soft_start = 0.5, .fade_out = 0.02};
constexpr double kPeriod = 1e-3;

// Brings a stage to a steady force.
Vec3 settle(OutputStage& stage, const Vec3& command) {
  Vec3 f = Vec3::Zero();
  for (int i = 0; i < 1000; ++i) f = stage.step({command, false, false}, kPeriod);
  return f;
}

// The invariants, whatever the graph commands: finite, at most the limit, never faster than the slew limit.
// Hostile input: NaN, infinities, 1e308, denormals, jumps; watchdog and stop at random. Tolerance: rounding.
TEST(OutputStage, IsFiniteBoundedAndRateLimitedForAnyInput) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const double hostile[] = {std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity(),
                            -std::numeric_limits<double>::infinity(),
                            1e308,
                            -1e308,
                            5e-324,
                            0.0};
  for (int run = 0; run < 200; ++run) {
    OutputStage stage(kLimits);
    Vec3 before = Vec3::Zero();
    const bool may_break = run % 2 == 0;
    for (int tick = 0; tick < 500; ++tick) {
      Vec3 command(normal(random), normal(random), normal(random));
      command *= std::exp(6 * normal(random));
      if (may_break && random() % 200 == 0) command[static_cast<int>(random() % 3)] = hostile[random() % 7];
      const Vec3 f = stage.step({command, random() % 17 == 0, random() % 400 == 0}, kPeriod);
      ASSERT_TRUE(f.allFinite());
      ASSERT_LE(f.norm(), kLimits.force * (1 + 1e-12));
      ASSERT_LE((f - before).norm(), kLimits.force_rate * kPeriod * (1 + 1e-9));
      before = f;
    }
  }
}

// A command that is no number latches: the force fades to zero within the fade time and stays there, whatever follows.
TEST(OutputStage, NotANumberLatchesZero) {
  OutputStage stage(kLimits);
  EXPECT_NEAR(settle(stage, {3, 0, 0}).x(), 3, 1e-12);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Vec3 f = stage.step({{nan, 0, 0}, false, false}, kPeriod);
  EXPECT_GT(f.x(), 2);  // no step
  for (int i = 0; i < 25; ++i) f = stage.step({{5, 0, 0}, false, false}, kPeriod);
  EXPECT_EQ(f.norm(), 0);
  EXPECT_TRUE(stage.latched());
  EXPECT_NE(stage.status() & kOutputNotFinite, 0u);
}

// Soft start: after half the time half the force.
TEST(OutputStage, StartsSoftly) {
  OutputStage stage(kLimits);
  Vec3 f = Vec3::Zero();
  for (int i = 0; i < 250; ++i) f = stage.step({{4, 0, 0}, false, false}, kPeriod);
  EXPECT_NEAR(f.x(), 2, 1e-9);
}

// Old information: zero within the fade time; when it is back, softly up again.
TEST(OutputStage, WatchdogFadesAndComesBack) {
  OutputStage stage(kLimits);
  settle(stage, {4, 0, 0});
  Vec3 f = Vec3::Zero();
  for (int i = 0; i < 21; ++i) f = stage.step({{4, 0, 0}, true, false}, kPeriod);
  EXPECT_EQ(f.norm(), 0);
  EXPECT_NE(stage.status() & kOutputWatchdog, 0u);
  EXPECT_NEAR(settle(stage, {4, 0, 0}).x(), 4, 1e-12);
}

// What is within the limits passes unchanged to the bit.
TEST(OutputStage, LeavesAGoodCommandAlone) {
  OutputStage stage(kLimits);
  const Vec3 wanted(1.25, -0.3, 2.1);
  EXPECT_EQ(settle(stage, wanted), wanted);
  EXPECT_EQ(stage.status(), kOutputClean);
}

}  // namespace
}  // namespace presa
