#include "framework/record/monitor/action_reaction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace presa {
namespace {

constexpr double kTick = 0.001, kStep = 0.005;

Scene sceneWithOneBody(bool fixed) {
  Scene scene;
  scene.devices.resize(1);
  scene.bodies.resize(1);
  scene.bodies[0].fixed = fixed;
  return scene;
}

/// Half a second in which a finger presses with 2 + sin N and the object receives `share` of it: the samples within
/// half a step of the end of each step. In lockstep a step is published at its start. The finger touches from time
/// `touch` on.
ActionReaction::Result run(double share, bool fixed = false, double touch = 0) {
  ActionReaction reaction(sceneWithOneBody(fixed));
  ContactExchange contact(1);
  auto objects = std::make_unique<ObjectState>();
  objects->bodies.resize(1);
  objects->touches = BoundedList<FingerImpulse>(1);
  FingerImpulse& impulse = *objects->touches.add({.finger = 0, .body = 0});
  const auto force = [touch](double t) { return t < touch ? 0.0 : 2 + std::sin(40 * t); };
  for (int i = 0; i < 500; ++i) {
    const double time = i * kTick;
    const bool fresh = i % 5 == 0;
    if (fresh) {
      objects->time_begin = time;
      objects->time_end = time + kStep;
      for (int k = 3; k <= 7; ++k) impulse.impulse_W += Vec3(0, 0, -share * kTick * force((i + k) * kTick));
    }
    FingerContact& finger = contact.fingers[0];
    finger.mode = time < touch ? ContactMode::kNone : ContactMode::kStick;
    finger.body = time < touch ? kNoBody : 0;
    finger.contact_count = time < touch ? 0 : 1;
    contact.contacts.clear();
    if (time >= touch) contact.contacts.add({.body = 0, .f_H_W = Vec3(0, 0, force(time))});
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
  EXPECT_EQ(result.windows, 99u - 20u) << "100 steps, the last not yet rendered";
  EXPECT_LT(result.worst, 1e-9);
}

TEST(ActionReaction, TwoPercentTooLittleIsSeenAsTwoPercent) { EXPECT_NEAR(run(0.98).worst, 0.02, 1e-9); }

TEST(ActionReaction, OnlyWindowsInsideOneTouchOfAFreeBodyCount) {
  EXPECT_EQ(run(0, true).windows, 0u);
  const ActionReaction::Result late = run(1, false, 0.25);
  EXPECT_GT(late.windows, 20u);
  EXPECT_LT(late.windows, 32u);
  EXPECT_LT(late.worst, 1e-9);
}

}  // namespace
}  // namespace presa
