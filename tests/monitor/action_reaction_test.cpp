#include "framework/monitor/action_reaction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace presa {
namespace {

constexpr double kTick = 0.001, kStep = 0.005;

Scene sceneWithOneBody(bool fixed) {
  Scene scene;
  scene.bodies.resize(1);
  scene.bodies[0].fixed = fixed;
  return scene;
}

/// Half a second of a finger that presses with 2 + sin N while the object gets `share` of it: the samples within half a step
/// of the end of each step. In lockstep a step is published at its begin. The finger touches from `touch` to `leave`, without
/// force in the last 6 ms, of which the object hears a step late.
ActionReaction::Result run(double share, bool fixed = false, double touch = 0, double leave = 1) {
  ActionReaction reaction(sceneWithOneBody(fixed));
  ContactExchange contact;
  contact.count = 1;
  auto objects = std::make_unique<ObjectState>();
  objects->count = 1;
  const auto force = [touch](double t) { return t < touch ? 0.0 : 2 + std::sin(40 * t); };
  const auto rendered = [&](double t) { return t >= leave - 0.006 ? 0.0 : force(t); };
  for (int i = 0; i < 500; ++i) {
    const double time = i * kTick;
    const bool fresh = i % 5 == 0;
    if (fresh) {
      objects->time_begin = time;
      objects->time_end = time + kStep;
      for (int k = 3; k <= 7; ++k) {
        const double given = time > leave - 0.006 ? 0 : force((i + k) * kTick);
        objects->finger_impulse_W[0] += Vec3(0, 0, -share * kTick * given);
      }
    }
    FingerContact& finger = contact.fingers[0];
    const bool touches = time >= touch && time < leave;
    finger.mode = !touches ? ContactMode::kNone : ContactMode::kStick;
    finger.body = touches ? 0 : kNoBody;
    finger.f_H_W = Vec3(0, 0, rendered(time));
    Tick tick;
    tick.index = static_cast<std::uint64_t>(i);
    tick.time = time;
    tick.period = kTick;
    reaction.add(tick, contact, *objects, fresh);
  }
  return reaction.of(0);
}

TEST(ActionReaction, EqualImpulsesAgreeToRounding) {
  const ActionReaction::Result result = run(1);
  EXPECT_EQ(result.windows, 99u - 20u - 2u)
      << "100 steps, the last not yet rendered, two more to see that the touch lasts";
  EXPECT_LT(result.worst, 1e-9);
}

TEST(ActionReaction, TwoPercentTooLittleIsSeenAsTwoPercent) { EXPECT_NEAR(run(0.98).worst, 0.02, 1e-9); }

// A finger that is gone from one tick to the next: the step that was on its way gives what nobody feels, up to one step of the
// force in 0.1 s, 5 %; it is told apart from what goes wrong while the touch lasts.
TEST(ActionReaction, TheStepThatStraddlesTheEndOfATouchIsToldApart) {
  const ActionReaction::Result result = run(1, false, 0, 0.309);
  EXPECT_LT(result.worst, 1e-9);
  EXPECT_GT(result.at_end, 0.03);
  EXPECT_LT(result.at_end, 0.06);
  EXPECT_GT(result.windows, 20u);
  EXPECT_EQ(run(1).at_end, 0) << "still touching";
}

TEST(ActionReaction, OnlyWindowsInsideOneTouchOfAFreeBodyCount) {
  EXPECT_EQ(run(0, true).windows, 0u);
  const ActionReaction::Result late = run(1, false, 0.25);
  EXPECT_GT(late.windows, 20u);
  EXPECT_LT(late.windows, 32u);
  EXPECT_LT(late.worst, 1e-9);
}

}  // namespace
}  // namespace presa
