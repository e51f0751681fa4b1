#include "apps/studies/cost/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace presa::cost {
namespace {

constexpr double kAmplitude = 0.3, kMean = 2, kFrequency = 80;

// A sinusoidal force of 80 Hz as held by a device of the given rate.
Evidence sineHeldAt(double rate) {
  Evidence e;
  e.compared_to = 1;
  e.trace.fingers = 1;
  for (int i = 0; i < static_cast<int>(rate); ++i) {
    const double time = i / rate;
    e.trace.held_from_ns.push_back(std::llround(time * 1e9));
    const double force = kMean + kAmplitude * std::sin(2 * std::numbers::pi * kFrequency * time);
    e.trace.held.push_back({static_cast<float>(force), 0, 0});
  }
  return e;
}

// The mean square difference of a sine and its sample-and-hold is A^2 (1 - sin(w T) / (w T)) over all phases. The
// reference is held too, for T_r = 1/64000 s, which changes the result by at most w T_r / 2 = 0.4 % of A.
TEST(Metrics, ForceAsHeldIsThatOfSampleAndHold) {
  const Evidence reference = sineHeldAt(64000);
  const Metric& newtons = *findMetric("force_held");
  for (const double rate : {1000.0, 500.0, 250.0}) {
    const double angle = 2 * std::numbers::pi * kFrequency / rate;
    const double expected = kAmplitude * std::sqrt(1 - std::sin(angle) / angle);
    EXPECT_NEAR(*newtons.error(sineHeldAt(rate), reference), expected, 0.005 * kAmplitude) << rate;
  }
  EXPECT_EQ(*newtons.error(reference, reference), 0);
}

// At 160 Hz the ticks fall on the zeros of an 80 Hz wave: the device holds the mean, and the whole wave is the error.
TEST(Metrics, AWaveThatARateCannotCarryIsItsOwnError) {
  EXPECT_NEAR(*findMetric("force_held")->error(sineHeldAt(160), sineHeldAt(64000)), kAmplitude / std::numbers::sqrt2,
              1e-3 * kAmplitude);
}

// In just-noticeable steps each difference is divided by a tenth of the current force.
TEST(Metrics, ForceAsHeldInSteps) {
  Evidence a, b;
  a.compared_to = b.compared_to = 1;
  a.trace.fingers = b.trace.fingers = 1;
  a.trace.held_from_ns = b.trace.held_from_ns = {0, 1'000'000};
  a.trace.held = {{2, 0, 0}, {0, 0, 0}};
  b.trace.held = {{4, 0, 0}, {0, 0, 0}};  // no contact in the second tick: it does not count
  EXPECT_NEAR(*findMetric("force_held_jnd")->error(a, b), 2 / (kForceStep * 4), 1e-6);
}

}  // namespace
}  // namespace presa::cost
