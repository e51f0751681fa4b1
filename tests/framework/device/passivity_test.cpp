#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "framework/device/output_stage.h"

// A hand on a device with an active environment: its net energy from the device must not be positive.
namespace presa {
namespace {

constexpr double kPeriod = 1e-3;

/// A hand of 0.2 kg behind a spring and damper (300 N/m, 4 N s/m), pushed once; stepped exactly enough in ten parts a
/// tick.
struct Hand {
  double x = 0, v = 0.3;
  void step(double force) {
    for (int i = 0; i < 10; ++i) {
      v += (force - 300 * x - 4 * v) / 0.2 * kPeriod / 10;
      x += v * kPeriod / 10;
    }
  }
};

struct Outcome {
  double largest = 0;  // largest excursion of the hand in the last second [m]
  double given = 0;    // net energy to the hand over the whole run [J]
  double max_given = 0;
};

/// Ten seconds of an environment that drives: negative damping, 5 ms late.
Outcome live(bool passivity) {
  OutputStage stage({.passivity = passivity});
  Hand hand;
  std::array<double, 5> late{};
  Outcome outcome;
  double sent = 0, x_before = 0;
  for (int i = 0; i < 10'000; ++i) {
    outcome.given += sent * (hand.x - x_before);
    outcome.max_given = std::max(outcome.max_given, outcome.given);
    x_before = hand.x;
    const double wish = late[static_cast<std::size_t>(i % 5)];
    late[static_cast<std::size_t>(i % 5)] = 12 * hand.v;
    sent = stage.step({.command = Vec3(wish, 0, 0), .p_WH = {hand.x, 0, 0}, .v_WH = {hand.v, 0, 0}}, kPeriod).f.x();
    hand.step(sent);
    if (i >= 9000) outcome.largest = std::max(outcome.largest, std::abs(hand.x));
  }
  return outcome;
}

TEST(Passivity, AnActiveEnvironmentGivesNoNetEnergy) {
  const Outcome without = live(false), with = live(true);
  // the environment does drive the hand: it swings for good, up to the limit of force
  EXPECT_GT(without.largest, 0.01);
  EXPECT_GT(without.given, 1);
  // with the controller it comes to rest. What it may be ahead by: one tick's error of predicting f v T, 8 N at most
  EXPECT_LT(with.largest, 1e-4);
  EXPECT_LT(with.given, 1e-4);
  EXPECT_LT(with.max_given, 8 * 0.3 * kPeriod);
}

// A passive wall in front of a moving hand: the controller does not reduce the energy that the wall may give back. The
// hand waits for the soft start, because a spring that grows stiffer while it is pressed does give energy.
TEST(Passivity, APassiveEnvironmentIsLeftAlone) {
  OutputStage with({.passivity = true}), without({});
  double largest = 0;
  for (int i = 0; i < 4000; ++i) {
    const double t = std::max(0, i - 600) * kPeriod, x = 0.005 * (1 - std::cos(2 * t)), v = 0.01 * std::sin(2 * t);
    const Vec3 wall(-500 * x - 2 * v, 0, 0);
    const Vec3 a = with.step({.command = wall, .p_WH = {x, 0, 0}, .v_WH = {v, 0, 0}}, kPeriod).f;
    const Vec3 b = without.step({.command = wall, .p_WH = {x, 0, 0}, .v_WH = {v, 0, 0}}, kPeriod).f;
    largest = std::max(largest, (a - b).norm());
  }
  EXPECT_EQ(largest, 0);
}

}  // namespace
}  // namespace presa
