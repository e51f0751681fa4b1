// The hum of a surface against its formula, and the shipped scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/apps/support/support.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/lockstep_run.h"
#include "tests/support/rendered_body.h"

namespace presa {
namespace {

constexpr double kPeriod = 1e-3, kTop = 0.058;  // of the fingertip's centre on the box [m]
constexpr double kStiffness = 1000, kFrequency = 125, kAmplitude = 0.4, kOn = 0.2, kOff = 0.3;
// 0.2 s are 25 periods, and so is the 0.2035 s of the file
const std::string kHum = R"(<vibration frequency="125" amplitude="0.4" on="0.2035" off="0.3"/>)";

test::RenderedBody box(const std::string& hum) {
  return {R"(<haptics renderer="god_object"/>)", R"(<box size="0.1 0.1 0.1"/>)", {}, hum};
}

/// Of the tick that ends at `time`, with a fingertip so deep.
double formula(double time, double depth) {
  const double t = std::fmod(time, kOn + kOff), spring = kStiffness * depth;
  return spring + (t < kOn ? std::min(kAmplitude, spring) * std::sin(2 * std::numbers::pi * kFrequency * t) : 0);
}

// Deeper and shallower than the amplitude, in bursts and between them. The place of the proxy is known to 1 nm.
TEST(Vibration, SwingsAsItsFormulaSays) {
  for (const double depth : {0.002, 0.0002}) {
    test::RenderedBody humming = box(kHum);
    humming.force({0, 0, kTop + 0.001});
    for (int i = 2; i <= 1200; ++i) {
      const double time = i * kPeriod;
      // a burst begins or ends in this tick: at its border rounding decides, but both sides are zero there
      EXPECT_NEAR(humming.force({0.01, 0, kTop - depth}).z(), formula(time, depth), 1e-5) << time;
    }
  }
}

// A fingertip that comes from above, through the surface and out again meets no step: the force differs by at most that of the way, and by
// the slope of the sinusoid, in a tick.
TEST(Vibration, HasNoStepWhereAFingertipComesAndGoes) {
  test::RenderedBody humming = box(kHum);
  constexpr double kSpeed = 0.02;
  double last = 0, height = 0.001;
  const double bound = 2 * kStiffness * kSpeed * kPeriod + 2 * std::numbers::pi * kFrequency * kAmplitude * kPeriod;
  for (int i = 0; i < 2000; ++i) {
    height += (i / 100 % 2 == 0 ? -1 : 1) * kSpeed * kPeriod;
    const double force = humming.force({0, 0.01, kTop + height}).z();
    EXPECT_GE(force, 0);
    EXPECT_LE(std::abs(force - last), bound) << i;
    last = force;
  }
}

TEST(Vibration, NeitherAllocatesNorLocks) {
  test::RenderedBody humming = box(kHum);
  humming.force({0, 0, kTop + 0.002});
  RealTimeGuard guard;
  for (int i = 0; i < 50; ++i) humming.force({0, 0, kTop - 1e-5 * i});
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

TEST(SceneWithVibration, HumsUnderTheFinger) {
  const std::string scene = test::source("config/scenes/vibration.xml");
  const test::LockstepRun run(scene), nearly_mute(scene, {"material/telephone/vibration/amplitude=0.001"});
  EXPECT_TRUE(run.faults().empty()) << run.faults().front();
  EXPECT_GT(run.maxNormalForce("index"), nearly_mute.maxNormalForce("index") + 0.2);
  const test::Outcome explained = test::presa("explain " + scene);
  EXPECT_NE(explained.out.find("presa_vibration.so"), std::string::npos) << explained.out;
  EXPECT_NE(explained.out.find("vibration: 0.4 N at 150 Hz, 0.4 s of every 1 s"), std::string::npos) << explained.out;
}

TEST(BadVibration, IsRefusedWithItsPlace) {
  const test::Outcome slow = test::presa("run " + test::source("config/scenes/vibration.xml") +
                                         " --lockstep --set rates/haptic=500 --set rates/dynamics=100");
  EXPECT_EQ(slow.status, 2);
  EXPECT_NE(slow.err.find("vibration.xml:"), std::string::npos) << slow.err;
  EXPECT_NE(slow.err.find("frequency is above a quarter of the haptic rate"), std::string::npos) << slow.err;
}

}  // namespace
}  // namespace presa
