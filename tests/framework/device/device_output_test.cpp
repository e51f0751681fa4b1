#include <gtest/gtest.h>

#include <cmath>

#include "framework/core/graph/graph_builder.h"
#include "framework/device/device_modules.h"
#include "tests/framework/device/stand_ins.h"

namespace presa {
namespace {

using test::Neighbourhoods;
using test::Objects;

/// A finger that stands still and keeps the forces sent to it.
class StillFinger final : public Device {
 public:
  FingerInput read(const Tick&) noexcept override { return {.valid = !silent, .lost = lost}; }
  void write(const Wrench& F_H_W, const Tick&) noexcept override {
    steepest = std::max(steepest, (F_H_W.f - force).norm());
    force = F_H_W.f;
    ++writes;
  }
  bool silent = false, lost = false;
  int writes = 0;
  Vec3 force = Vec3::Zero();
  double steepest = 0;
};

struct Rig {
  explicit Rig(const Rates& scene = {}, std::size_t fingers = 1) : rates(scene) {
    while (devices.size() < fingers) devices.push_back(std::make_unique<StillFinger>());
    finger = static_cast<StillFinger*>(devices[0].get());
    GraphBuilder builder;
    builder.add(std::make_unique<DeviceInput>(devices, control));
    rendering = &builder.add(std::make_unique<test::Commands>(Vec3(4, 0, 0), fingers));
    objects = &builder.add(std::make_unique<Objects>());
    builder.add(std::make_unique<Neighbourhoods>());
    output = &builder.add(std::make_unique<DeviceOutput>(
        devices, std::vector<FingerSafety>(fingers, {.limits = {}, .watchdog = ages::objects(scene)}), scene, false));
    builder.connectByName();
    graph = builder.build();
  }
  void run(int ticks, bool dynamics = true, bool collision = true) {
    for (; ticks > 0; --ticks, ++i) {
      if (dynamics) stepIfDue(RateGroup::kDynamics);
      if (collision) stepIfDue(RateGroup::kCollision);
      graph.step(RateGroup::kHaptic, rates.tick(RateGroup::kHaptic, i));
    }
  }
  void stepIfDue(RateGroup group) {
    const auto divisor = static_cast<std::uint64_t>(rates.divisor(group));
    if (i % divisor == 0) graph.step(group, rates.tick(group, i / divisor));
  }
  /// Catch-up ticks at one instant after a stall, as an executor runs them.
  void catchUp(int ticks) {
    for (; ticks > 0; --ticks, ++i) {
      Tick tick = rates.tick(RateGroup::kHaptic, i);
      tick.catch_up = ticks > 1;
      graph.step(RateGroup::kHaptic, tick);
    }
  }
  DeviceList devices;
  RunControl control;
  StillFinger* finger = nullptr;
  test::Commands* rendering = nullptr;
  Objects* objects = nullptr;
  DeviceOutput* output = nullptr;
  Graph graph;
  RateTable rates;
  std::uint64_t i = 0;
};

constexpr double kSlew = 1000 * 1e-3 * (1 + 1e-9);  // [N] a tick, the default force rate

// A fault in the dynamics takes the force down to zero within the fade, without a step, and for good.
TEST(DeviceOutput, ADynamicsFaultFadesTheForceForGood) {
  Rig rig;
  rig.run(1000);
  EXPECT_NEAR(rig.finger->force.x(), 4, 1e-9);
  rig.objects->fault = true;
  rig.run(30);
  EXPECT_EQ(rig.finger->force.norm(), 0);
  rig.run(1000);
  EXPECT_EQ(rig.finger->force.norm(), 0);
  EXPECT_LE(rig.finger->steepest, kSlew);
}

// Object State older than the role's watchdog (20 ms): the force fades, an event is reported, and it comes back softly.
TEST(DeviceOutput, AStalledDynamicsFadesTheForceUntilItIsBack) {
  Rig rig;
  rig.run(1000);
  rig.run(24, false);
  EXPECT_GT(rig.finger->force.x(), 0);  // fading, not cut
  rig.run(40, false);
  EXPECT_EQ(rig.finger->force.norm(), 0);
  FaultEvent event;
  bool told = false;
  while (rig.output->nextEvent(event)) told = told || (event.time > 0.9 && (event.status & kOutputWatchdog) != 0);
  EXPECT_TRUE(told);
  rig.run(1000);
  EXPECT_NEAR(rig.finger->force.x(), 4, 1e-9);
  EXPECT_LE(rig.finger->steepest, kSlew);
}

// Every rate that a scene may name: a value is as old as its writer's period just before the next one comes. That is
// its usual age, and the force stays; older than two periods, and than 20 ms, its writer has stopped, and the force
// goes.
TEST(DeviceOutput, WhatIsOldFollowsFromTheRateOfItsWriter) {
  for (const double rate : {10., 20., 40., 50., 100., 200., 1000.}) {
    const int period = static_cast<int>(std::lround(1000 / rate)), old_after = std::max(20, 2 * period);  // [ticks]
    for (const bool collision : {true, false}) {
      Rates scene;
      (collision ? scene.collision : scene.dynamics) = rate;
      Rig rig(scene);
      rig.run(1000);
      for (int i = 0; i < 5 * period; ++i) {
        rig.run(1);
        ASSERT_NEAR(rig.finger->force.x(), 4, 1e-9) << rate << " Hz, tick " << i;
      }
      rig.run((period - static_cast<int>(rig.i % static_cast<std::uint64_t>(period))) % period + 1);  // one just came
      rig.run(old_after - 1, collision, !collision);
      EXPECT_NEAR(rig.finger->force.x(), 4, 1e-9) << rate << " Hz: not old yet";
      rig.run(12, collision, !collision);
      EXPECT_LT(rig.finger->force.x(), 3) << rate << " Hz: its writer has stopped";
    }
  }
}

// A rendering that computes no contact in a tick: its last force is not used again; the force goes down from 4 N at
// 1 N/ms, and comes back softly.
TEST(DeviceOutput, AContactOfAnEarlierTickTakesTheForceDown) {
  Rig rig;
  rig.run(1000);
  rig.rendering->stalled = true;
  for (const double force : {3., 2., 1., 0.}) {
    rig.run(1);
    EXPECT_NEAR(rig.finger->force.x(), force, 1e-9);
  }
  rig.run(100);
  EXPECT_EQ(rig.finger->force.norm(), 0);
  rig.rendering->stalled = false;
  rig.run(1000);
  EXPECT_NEAR(rig.finger->force.x(), 4, 1e-9);
  EXPECT_LE(rig.finger->steepest, kSlew);
}

// A device that gives no sample: the force is held for a tick and is zero at 5 ms, from 4 N at 1 N/ms; softly back with
// the samples.
TEST(DeviceOutput, ASilentDeviceIsAtZeroAfterFiveMilliseconds) {
  Rig rig;
  rig.run(1000);
  rig.finger->silent = true;
  rig.run(1);
  EXPECT_NEAR(rig.finger->force.x(), 4, 1e-9);
  rig.run(3);
  EXPECT_GT(rig.finger->force.x(), 0.5);
  rig.run(1);
  EXPECT_NEAR(rig.finger->force.x(), 0, 1e-9);
  rig.finger->silent = false;
  rig.run(100);
  EXPECT_NEAR(rig.finger->force.x(), 4 * 0.1 / 0.5, 1e-9);
  EXPECT_LE(rig.finger->steepest, kSlew);
}

// A grasp must not close on a hand whose other finger went slack: the fault is the other's, the force of both goes.
TEST(DeviceOutput, ALostDeviceTakesTheForceOfTheOtherFingers) {
  Rig rig({}, 2);
  auto& other = static_cast<StillFinger&>(*rig.devices[1]);
  rig.run(1000);
  EXPECT_NEAR(other.force.x(), 4, 1e-9);
  rig.finger->lost = true;
  rig.run(30);
  EXPECT_EQ(other.force.norm(), 0);
  rig.finger->lost = false;
  rig.run(1000);
  EXPECT_EQ(other.force.norm(), 0);
  EXPECT_LE(other.steepest, kSlew);
}

// A device that is lost and comes back has no force until a re-arm, and then starts softly.
TEST(DeviceOutput, ALostDeviceAsksForARearm) {
  Rig rig;
  rig.run(1000);
  rig.finger->lost = true;
  rig.run(30);
  EXPECT_EQ(rig.finger->force.norm(), 0);
  rig.finger->lost = false;
  rig.run(1000);
  EXPECT_EQ(rig.finger->force.norm(), 0);
  ++rig.control.rearms;
  rig.run(100);
  EXPECT_NEAR(rig.finger->force.x(), 4 * 0.1 / 0.5, 1e-9);
  FaultEvent event;
  bool told = false;
  while (rig.output->nextEvent(event)) told = told || (event.status & kOutputLost) != 0;
  EXPECT_TRUE(told);
  EXPECT_LE(rig.finger->steepest, kSlew);
}

// Catch-up ticks fall on one instant for the device: it gets one force, which differs from the held one by at most the
// slew limit of one tick, for any number of catch-up ticks. The fade advances during all of them.
TEST(DeviceOutput, TicksMadeUpAtOneInstantAreOneStepOfTheForce) {
  Rig rig;
  rig.run(1000);
  const int before = rig.finger->writes;
  rig.objects->fault = true;
  rig.graph.step(RateGroup::kDynamics, rig.rates.tick(RateGroup::kDynamics, rig.i / 5));
  rig.catchUp(50);
  EXPECT_EQ(rig.finger->writes, before + 1);
  EXPECT_NEAR(rig.finger->force.x(), 4 - 1, 1e-9);
  rig.run(3, false);
  EXPECT_NEAR(rig.finger->force.x(), 0, 1e-9);
  EXPECT_LE(rig.finger->steepest, kSlew);
}

// No tick ran for ten seconds while the device held its last force: the next force is zero at once, without the slew
// limit of one tick, and stays zero until a re-arm.
TEST(DeviceOutput, TheFirstForceAfterAGapIsZero) {
  Rig rig;
  rig.run(1000);
  rig.i += 10'000;
  Tick tick = rig.rates.tick(RateGroup::kHaptic, rig.i++);
  tick.resumed = true;
  rig.graph.step(RateGroup::kHaptic, tick);
  EXPECT_EQ(rig.finger->force.norm(), 0);
  rig.run(1000);
  EXPECT_EQ(rig.finger->force.norm(), 0);
  FaultEvent event;
  bool told = false;
  while (rig.output->nextEvent(event)) told = told || (event.status & kOutputGap) != 0;
  EXPECT_TRUE(told);
  ++rig.control.rearms;
  rig.run(100);
  EXPECT_NEAR(rig.finger->force.x(), 4 * 0.1 / 0.5, 1e-9);
}

// The end of a run leaves no force on the finger, for any force before.
TEST(DeviceOutput, StopTakesTheForceDown) {
  Rig rig;
  rig.run(1000);
  rig.graph.stop(RateGroup::kHaptic);
  EXPECT_EQ(rig.finger->force.norm(), 0);
  EXPECT_LE(rig.finger->steepest, kSlew);
}

}  // namespace
}  // namespace presa
