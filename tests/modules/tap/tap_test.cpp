// The ring of a surface that is hit, against its formula; what a finger can draw from it; the shipped scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tests/apps/support/support.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/lockstep_run.h"
#include "tests/support/rendered_body.h"

namespace presa {
namespace {

constexpr double kPeriod = 1e-3, kTop = 0.058;  // of the fingertip's centre on the box [m]
constexpr double kFrequency = 120, kDecay = 0.02, kGain = 6, kLargest = 1.5;
constexpr double kW = 2 * std::numbers::pi * kFrequency;
const std::string kTap = R"(<tap frequency="120" decay="0.02" gain="6" max_force="1.5"/>)";

test::RenderedBody box(const std::string& tap) {
  return {R"(<haptics renderer="god_object"/>)", R"(<box size="0.1 0.1 0.1"/>)", {}, tap};
}

/// What the ring adds to the force along a way of heights over the surface, tick by tick [N].
std::vector<double> ringAlong(const std::vector<double>& heights) {
  test::RenderedBody ringing = box(kTap), mute = box("");
  std::vector<double> ring;
  for (const double height : heights) {
    const Vec3 p(0.01, 0.02, kTop + height);
    ring.push_back(ringing.force(p).z() - mute.force(p).z());
  }
  return ring;
}

/// From 1 mm over the surface down at that speed for `down` ticks after the first one in contact, then at rest.
std::vector<double> hit(double speed, int down, int ticks) {
  std::vector<double> heights{0.001};
  while (heights.back() > 0) heights.push_back(heights.back() - speed * kPeriod);
  const auto first = heights.size() - 1;
  while (heights.size() < first + static_cast<std::size_t>(ticks))
    heights.push_back(heights.back() -
                      (heights.size() - first <= static_cast<std::size_t>(down) ? speed * kPeriod : 0));
  return heights;
}

double formula(double amplitude, double t) { return amplitude * std::exp(-t / kDecay) * std::sin(kW * t); }

// 0.033 m/s and 0.12 m/s are no whole numbers of ticks to the surface. The speed comes from two depths that are known to the place of the
// proxy, 1 nm: 1e-6 m/s, and the force in between to 1e-6 N.
TEST(Tap, RingsAsItsFormulaSays) {
  for (const double speed : {0.033, 0.12}) {
    const std::vector<double> ring = ringAlong(hit(speed, 40, 150));
    const auto start = std::ranges::find_if(ring, [](double f) { return f != 0; }) - ring.begin() - 1;
    ASSERT_GT(start, 0);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const double t = (static_cast<double>(i) - static_cast<double>(start)) * kPeriod;
      EXPECT_NEAR(ring[i], t < 0 ? 0 : formula(kGain * speed, t), 1e-5) << speed << " m/s at " << t;
    }
  }
}

TEST(Tap, RingsNoLouderThanItsBound) {
  const std::vector<double> ring = ringAlong(hit(1, 4, 100));
  const double largest = std::ranges::max(ring);
  EXPECT_LE(largest, kLargest);
  EXPECT_GT(largest, kLargest * 0.85);  // a quarter of a period of a damped sinusoid, between two ticks
}

TEST(Tap, IsSilentWhereAFingertipLaysItselfDown) {
  for (const double f : ringAlong(hit(0.009, 100, 200))) EXPECT_EQ(f, 0);
}

// The second hit begins anew; the ring of the first does not go on in the air.
TEST(Tap, RingsAgainAtEachHit) {
  std::vector<double> heights = hit(0.1, 10, 30);
  const std::size_t once = heights.size();
  heights.insert(heights.end(), 5, 0.001);
  const std::vector<double> again = hit(0.1, 10, 30);
  heights.insert(heights.end(), again.begin(), again.end());
  const std::vector<double> ring = ringAlong(heights);
  for (std::size_t i = once; i < once + 5; ++i) EXPECT_EQ(ring[i], 0);
  for (std::size_t i = 0; i < once; ++i) EXPECT_NEAR(ring[i], ring[once + 5 + i], 1e-9) << i;
}

// A finger that leaves at one speed draws at most that speed times the largest integral of the ring over any time: that of its first push,
// A w / (w^2 + 1 / decay^2) (1 + exp(-pi / (w decay))). The force that is held between ticks adds a tick of the amplitude.
TEST(Tap, GivesAFingerThatLeavesNoMoreThanOnePush) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> speed(0.02, 0.2);
  std::uniform_int_distribution<int> wait(0, 30);
  for (int n = 0; n < 40; ++n) {
    const double in = speed(random), out = speed(random);
    std::vector<double> heights = hit(in, 15, 16 + wait(random));
    while (heights.back() < 0.001) heights.push_back(heights.back() + out * kPeriod);
    const std::vector<double> ring = ringAlong(heights);
    double work = 0;
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) work += ring[i] * (heights[i + 1] - heights[i]);
    const double amplitude = std::min(kGain * in, kLargest);
    const double push = kW / (kW * kW + 1 / (kDecay * kDecay)) * (1 + std::exp(-std::numbers::pi / (kW * kDecay)));
    EXPECT_LT(work, amplitude * (push + kPeriod) * out) << in << ' ' << out;
  }
}

TEST(Tap, NeitherAllocatesNorLocks) {
  test::RenderedBody ringing = box(kTap);
  const std::vector<double> heights = hit(0.1, 20, 60);
  ringing.force({0, 0, kTop + 0.002});
  RealTimeGuard guard;
  for (const double height : heights) ringing.force({0, 0, kTop + height});
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

TEST(SceneWithTaps, RunsWithoutAFaultAndRingsByMaterial) {
  const std::string scene = test::source("config/scenes/taps.xml");
  const test::LockstepRun run(scene), mute(scene, {"material/steel/tap/gain=0.1"});
  EXPECT_TRUE(run.faults().empty()) << run.faults().front();
  EXPECT_GT(run.maxNormalForce("index"), mute.maxNormalForce("index") + 0.2);
  const test::Outcome explained = test::presa("explain " + scene);
  EXPECT_NE(explained.out.find("presa_tap.so"), std::string::npos) << explained.out;
  EXPECT_NE(explained.out.find("tap: rings at 240 Hz"), std::string::npos) << explained.out;
  EXPECT_EQ(test::presa("explain " + test::source("config/scenes/plane.xml")).out.find("presa_tap.so"),
            std::string::npos);
}

TEST(BadTap, IsRefusedWithItsPlace) {
  const test::Outcome slow = test::presa("run " + test::source("config/scenes/taps.xml") +
                                         " --lockstep --set rates/haptic=500 --set rates/dynamics=100");
  EXPECT_EQ(slow.status, 2);
  EXPECT_NE(slow.err.find("taps.xml:"), std::string::npos) << slow.err;
  EXPECT_NE(slow.err.find("frequency is above a quarter of the haptic rate"), std::string::npos) << slow.err;
}

}  // namespace
}  // namespace presa
