#include "devices/novint_falcon/sample_gate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "devices/novint_falcon/kinematics.h"
#include "framework/core/math/random.h"

namespace presa::falcon {
namespace {

constexpr double kSpeed = 0.15;  // of the hand [m/s]

Counts encodersAt(double time) {
  const ThighAngles zero = thighAngles({0, 0, 0}), one = thighAngles({1, 1, 1});
  const ThighAngles angles = inverse(Vec3(0, 0, 0.12 + kSpeed * time)).value();
  Counts counts{};
  for (int leg = 0; leg < 3; ++leg)
    counts[static_cast<std::size_t>(leg)] =
        static_cast<std::int32_t>(std::lround((angles[leg] - zero[leg]) / (one[leg] - zero[leg])));
  return counts;
}

// A reply that comes 30 ms late is attributed to a current request, and the next one shows the motion in between: that
// must give neither a velocity nor a fault.
TEST(FalconSampleGate, ALateReplyIsNoSpeed) {
  SampleGate gate(3, 1e-3);
  RandomStream random(1, "late");
  double time = 0, fastest = 0;
  for (int gap = 0; gap < 200; ++gap) {
    const double late = random.uniform(3e-3, 0.03);
    for (const double end = time + 0.05; time < end; time += 1e-3)
      ASSERT_EQ(gate.take(encodersAt(std::fmod(time, 0.3)), time), SampleGate::Verdict::kGood);
    EXPECT_NEAR(gate.velocity().z(), kSpeed, 0.03);  // encoder steps
    const double asked = time;
    for (; time < asked + late; time += 1e-3) {
      if (time > asked + 2e-3) gate.unsettle(time - 2e-3, time);
    }
    ASSERT_NE(gate.take(encodersAt(std::fmod(asked, 0.3)), time), SampleGate::Verdict::kLatched);
    time += 0.3e-3;
    ASSERT_EQ(gate.take(encodersAt(std::fmod(time, 0.3)), time), SampleGate::Verdict::kGood) << late;
    fastest = std::max(fastest, gate.velocity().norm());
    if (std::fmod(time, 0.3) > 0.2) {
      time += 0.1;  // the hand returns
      gate.reset();
    }
  }
  EXPECT_LT(fastest, 1.2 * kSpeed);
}

// An impossible jump is rejected also while replies are late.
TEST(FalconSampleGate, AJumpIsRejectedWhileRepliesAreLate) {
  SampleGate gate(3, 1e-3);
  ASSERT_EQ(gate.take(encodersAt(0), 0), SampleGate::Verdict::kGood);
  for (double time = 1e-3; time < 1; time += 1e-3) gate.unsettle(time, time + 2e-3);
  EXPECT_EQ(gate.take(encodersAt(0), 1), SampleGate::Verdict::kGood);
  gate.unsettle(1, 1.002);
  EXPECT_EQ(gate.take(encodersAt(0.25), 1.003), SampleGate::Verdict::kRejected);  // 37 mm
}

}  // namespace
}  // namespace presa::falcon
