// What a fingertip judges of a surface: torque, stiffness, friction, texture.
#include "apps/studies/cost/felt_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace presa::cost {
namespace {

constexpr double kPi = std::numbers::pi;

/// One instant of one finger that touches.
Evidence instant(const FingerSample& sample) {
  Evidence e;
  e.compared_to = 1;
  e.trace.fingers = 1;
  e.trace.time_ns = {0};
  e.trace.finger = {sample};
  e.trace.finger[0].touching = 1;
  return e;
}

TEST(FeltMetrics, StiffnessIsForceOverStretch) {
  FingerSample soft, hard;
  soft.force[2] = 0.9, soft.stretch = 0.0015;
  hard.force[0] = 0.6, hard.force[1] = 0.8, hard.stretch = 0.001;
  EXPECT_NEAR(*stiffnessError(instant(soft), instant(hard)), 40, 1e-9);
  hard.stretch = 4e-5;  // too little to judge
  EXPECT_FALSE(stiffnessError(instant(soft), instant(hard)));
}

TEST(FeltMetrics, FrictionIsJudgedWhileTheReferenceSlips) {
  FingerSample rough, smooth;
  rough.traction = 0.66;
  smooth.traction = 0.6;
  EXPECT_FALSE(frictionError(instant(rough), instant(smooth)));
  smooth.slipping = 1;
  EXPECT_NEAR(*frictionError(instant(rough), instant(smooth)), 10, 1e-9);
}

TEST(FeltMetrics, TorqueIsThatOfTheCommand) {
  FingerSample turned;
  turned.torque[0] = 0.003, turned.torque[2] = -0.004;
  EXPECT_NEAR(*torqueError(instant(turned), instant({})), 5, 1e-12);
}

/// A force along y as held at `rate`, for 2 s; the last second is compared.
template <class Force>
Evidence held(double rate, const Force& force) {
  Evidence e;
  e.compared_from = 1;
  e.compared_to = 2;
  e.trace.fingers = 1;
  for (int i = 0; i <= static_cast<int>(2 * rate); ++i) {
    e.trace.held_from_ns.push_back(std::llround(i / rate * 1e9));
    e.trace.held.push_back({0, static_cast<float>(force(i / rate)), 0});
  }
  e.vibration = vibrationOf(e);
  return e;
}

// Gain of a high-pass at 40 Hz and a low-pass at 400 Hz, of first order. At 20 kHz the hold takes (pi f T)^2 / 6 of the
// amplitude, 6e-4 at 400 Hz.
TEST(FeltMetrics, TextureIsTheBandFrom40To400Hertz) {
  constexpr double kAmplitude = 0.3;
  const Evidence still = held(20'000, [](double) { return 2.0; });
  for (const double frequency : {5.0, 40.0, 100.0, 400.0}) {
    const Evidence wave =
        held(20'000, [=](double time) { return 2 + kAmplitude * std::sin(2 * kPi * frequency * time); });
    const double low = frequency / 40, high = frequency / 400;
    const double gain = low / std::hypot(1, low) / std::hypot(1, high);
    EXPECT_NEAR(*textureError(wave, still), gain * kAmplitude / std::numbers::sqrt2, 0.001 * kAmplitude) << frequency;
  }
}

// A fifth of the vibration; of one too faint no share is known.
TEST(FeltMetrics, TextureIsFeltToAFifth) {
  const auto wave = [](double amplitude) {
    return held(20'000, [=](double time) { return 2 + amplitude * std::sin(2 * kPi * 100 * time); });
  };
  const Evidence still = held(20'000, [](double) { return 2.0; });
  EXPECT_NEAR(*textureNoticeable(wave(0.3)), 0.2 * *textureError(wave(0.3), still), 1e-6);
  EXPECT_FALSE(textureNoticeable(wave(0.01)));
}

// A force that is held for 4 ms is the same texture, whether one tick of 250 Hz or four of 1 kHz hold it.
TEST(FeltMetrics, TextureDependsOnTheForceAndNotOnTheTicks) {
  const auto steps = [](double time) { return std::sin(1.7 * std::floor(time * 250 + 1e-6)); };
  const Evidence still = held(250, [](double) { return 0.0; });
  const double slow = *textureError(held(250, steps), still), fast = *textureError(held(1000, steps), still);
  EXPECT_GT(slow, 0.1);
  EXPECT_NEAR(fast, slow, 1e-9);
}

}  // namespace
}  // namespace presa::cost
