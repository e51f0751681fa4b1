// The lectures' "buzzing": waves that a finger crosses at 80 Hz, felt at the rate of the haptic thread.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/modules/texture/texture_fixture.h"

namespace presa::buzz {
namespace {

constexpr double kBuzz = 80, kWavelength = 0.001, kAmplitude = 0.0001, kDeep = 0.001;  // [Hz], [m]

/// RMS of the force that is held from tick to tick less that of the place where the finger is, in parts of the amplitude.
double heldError(double rate) {
  test::OnSide finger(test::texturedCube({.shape = "sine", .amplitude = kAmplitude, .wavelength = kWavelength}), 0);
  const double speed = kBuzz * kWavelength;
  const auto forceAt = [&](double time) {
    return finger.force(std::fmod(speed * time, 20 * kWavelength), 0, kDeep).z();
  };
  constexpr int kFine = 50, kTicks = 1000;  // whole waves later the place is the same
  double sum = 0;
  for (int tick = 0; tick < kTicks; ++tick) {
    const double held = forceAt(tick / rate);
    for (int i = 0; i < kFine; ++i) {
      const double error = held - forceAt((tick + (i + 0.5) / kFine) / rate);
      sum += error * error;
    }
  }
  return std::sqrt(sum / (kFine * kTicks)) / (1000 * kAmplitude);
}

// Zero-order hold of a sine of amplitude a and frequency f at the period h: RMS error a sqrt(1 - sin(w) / w), w = 2 pi f h.
TEST(Buzzing, TheHeldForceIsWrongAsAZeroOrderHoldIs) {
  double at_1000 = 0;
  for (const auto& [rate, printed] : {std::pair{1000.0, 0.204}, {500.0, 0.400}, {250.0, 0.742}, {167.0, 0.978}}) {
    const double w = 2 * std::numbers::pi * kBuzz / rate, oracle = std::sqrt(1 - std::sin(w) / w);
    EXPECT_NEAR(oracle, printed, 5e-4);
    const double error = heldError(rate);
    EXPECT_NEAR(error / oracle, 1, 0.02) << rate;
    if (rate == 1000) at_1000 = error;
    RecordProperty("error_at_" + std::to_string(static_cast<int>(rate)), std::to_string(error));
  }
  EXPECT_NEAR(heldError(500) / at_1000, 1.96, 0.04);
}

}  // namespace
}  // namespace presa::buzz
