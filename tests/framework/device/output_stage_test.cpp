#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "framework/device/output_stage.h"
#include "tests/support/effort.h"

namespace presa {
namespace {

constexpr OutputLimits kLimits{.force = 8, .force_rate = 1000, .soft_start = 0.5, .fade_out = 0.02};
constexpr double kPeriod = 1e-3;
using Trust = OutputStage::Trust;

// Brings a stage to a steady force.
Vec3 settle(OutputStage& stage, const Vec3& command) {
  Vec3 f = Vec3::Zero();
  for (int i = 0; i < 1000; ++i) f = stage.step({.command = command}, kPeriod).f;
  return f;
}

/// A number of random bits: NaN, infinities, denormals and 1e308 occur.
double anyDouble(std::mt19937_64& random) { return std::bit_cast<double>(random()); }

// The invariants over ten million cycles of hostile input: finite, at most the limit, never faster than the slew limit, the
// torque like the force. Commands are any bit patterns or jumps of a plausible size; positions and velocities too; every verdict of the
// watchdogs, stops, stalls, lost devices and re-arms come at random; with and without each of the optional stages.
// Tolerance: rounding.
TEST(OutputStage, IsFiniteBoundedAndRateLimitedForAnyInput) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto vector = [&](double share_of_any, double size) {
    Vec3 v(size * normal(random), size * normal(random), size * normal(random));
    if (std::generate_canonical<double, 53>(random) < share_of_any)
      v[static_cast<int>(random() % 3)] = anyDouble(random);
    return v;
  };
  const auto turned = [&](double share_of_any) {
    const Vec3 v = vector(share_of_any, 1);
    return Quat(normal(random), v.x(), v.y(), v.z()).normalized();
  };
  constexpr int kRuns = unlessSanitized(2000, 200);
  constexpr int kTicks = 5000;
  std::uint64_t latched = 0, moved = 0, at_limit = 0, at_slew = 0, torque_at_limit = 0;
  for (int run = 0; run < kRuns; ++run) {
    OutputLimits limits = kLimits;
    limits.passivity = run % 2 == 0;
    if (run % 3 != 0) limits.continuous = 4, limits.heating_time = 0.5;
    limits.records_overload = run % 5 == 0;
    if (run % 7 == 0) limits.speed = 1, limits.angular_speed = 20;
    if (run % 2 == 1 || run % 4 == 0) limits.torque = 0.3, limits.torque_rate = 30;
    if (run % 3 == 1) limits.continuous_torque = 0.1;
    const double hostile = run % 4 == 0 ? 0.5 : 1e-3;
    OutputStage stage(limits);
    Wrench before, steady;
    for (int tick = 0; tick < kTicks; ++tick) {
      // not more often: each re-arm begins a soft start, and a force that never grows reaches no limit
      if (stage.latched() ? random() % 70 == 0 : random() % 20'000 == 0) stage.rearm();
      if (random() % 60 == 0) steady = {vector(hostile, 10), vector(hostile, 0.4)};
      const std::uint64_t dice = random() % 256;
      const OutputStage::Input input{
          .command = random() % 8 == 0 ? Wrench(vector(hostile, 10), vector(hostile, 0.4)) : steady,
          .trust = dice == 0   ? Trust::kFading
                   : dice == 1 ? Trust::kDropped
                               : Trust::kGood,
          .stop = dice == 2,
          .catch_up = dice == 3,
          .lost = random() % 2000 == 0,
          .p_WH = vector(hostile, 0.1),
          .v_WH = vector(hostile, 0.5),
          .w_WT = vector(hostile, 10),
          .q_WT = turned(hostile)};
      const auto [f, t] = stage.step(input, kPeriod);
      ASSERT_TRUE(t.allFinite()) << run << " " << tick;
      ASSERT_LE(t.norm(), limits.torque * (1 + 1e-12));
      ASSERT_LE((t - before.t).norm(), limits.torque_rate * kPeriod * (1 + 1e-9));
      torque_at_limit += limits.torque > 0 && t.norm() > 0.999 * limits.torque ? 1 : 0;
      ASSERT_TRUE(f.allFinite()) << run << " " << tick;
      ASSERT_LE(f.norm(), limits.force * (1 + 1e-12));
      ASSERT_LE((f - before.f).norm(), limits.force_rate * kPeriod * (1 + 1e-9));
      latched += stage.latched() ? 1 : 0;
      moved += f.norm() > 0 ? 1 : 0;
      at_limit += f.norm() > 0.999 * limits.force ? 1 : 0;
      at_slew += (f - before.f).norm() > 0.999 * limits.force_rate * kPeriod ? 1 : 0;
      before = {f, t};
    }
  }
  // or nothing was tried
  EXPECT_GT(latched, 500U * kRuns);
  EXPECT_GT(moved, 500U * kRuns);
  EXPECT_GT(at_limit, 50U * kRuns);
  EXPECT_GT(at_slew, 500U * kRuns);
  EXPECT_GT(torque_at_limit, 50U * kRuns);
  std::printf("of %d cycles %llu at the force limit, %llu at the slew limit, %llu latched\n", kRuns * kTicks,
              static_cast<unsigned long long>(at_limit), static_cast<unsigned long long>(at_slew),
              static_cast<unsigned long long>(latched));
}

// The torque fades, drops, trips and warms as the force does, with limits of its own.
TEST(OutputStage, TreatsTheTorqueAsTheForce) {
  OutputLimits limits = kLimits;
  limits.torque = 0.2, limits.torque_rate = 20;
  const auto settled = [&] {
    OutputStage stage(limits);
    for (int i = 0; i < 1000; ++i) stage.step({.command = {Vec3(4, 0, 0), Vec3(0, 1, 0)}}, kPeriod);
    return stage;
  };
  OutputStage dropped = settled();
  EXPECT_NEAR(dropped.last().t.y(), 0.2, 1e-12);
  EXPECT_NE(dropped.status() & kOutputMagnitude, 0u);
  for (int i = 1; i <= 10; ++i) dropped.step({.trust = Trust::kDropped}, kPeriod);
  EXPECT_NEAR(dropped.last().t.norm(), 0, 1e-12);  // 0.2 N m at 20 N m/s

  const double nan = std::numeric_limits<double>::quiet_NaN();
  OutputStage broken = settled();
  for (int i = 0; i < 12; ++i) broken.step({.command = {Vec3(4, 0, 0), Vec3(nan, 0, 0)}}, kPeriod);
  EXPECT_TRUE(broken.last() == Wrench());
  EXPECT_TRUE(broken.latched());

  limits.angular_speed = 10;
  OutputStage driven = settled(), braked = settled();
  for (int i = 0; i < 3; ++i) {
    driven.step({.command = {Vec3::Zero(), Vec3(0, 1, 0)}, .w_WT = {0, 15, 0}}, kPeriod);
    braked.step({.command = {Vec3::Zero(), Vec3(0, 1, 0)}, .w_WT = {0, -15, 0}}, kPeriod);
  }
  EXPECT_NE(driven.status() & kOutputSpeed, 0u);
  EXPECT_EQ(braked.status() & kOutputSpeed, 0u);

  limits.continuous_torque = 0.05, limits.heating_time = 1;
  OutputStage warm = settled();
  for (int i = 0; i < 10'000; ++i) warm.step({.command = {Vec3::Zero(), Vec3(0, 1, 0)}}, kPeriod);
  EXPECT_NEAR(warm.last().t.norm(), 0.05, 1e-6);
  EXPECT_NE(warm.status() & kOutputWarm, 0u);
}

// A driver without torque gets none.
TEST(OutputStage, SendsNoTorqueToADriverThatTakesNone) {
  OutputStage stage(kLimits);
  for (int i = 0; i < 1000; ++i) stage.step({.command = {Vec3(4, 0, 0), Vec3(0, 1, 0)}}, kPeriod);
  EXPECT_TRUE(stage.last().t.isZero(0));
}

// A command that is not finite latches: the force goes down at the slew limit and stays at zero for any later command.
TEST(OutputStage, NotANumberLatchesZero) {
  OutputStage stage(kLimits);
  EXPECT_NEAR(settle(stage, {3, 0, 0}).x(), 3, 1e-12);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Vec3 f = stage.step({.command = Vec3(nan, 0, 0)}, kPeriod).f;
  EXPECT_NEAR(f.x(), 2, 1e-9);  // no step
  for (int i = 0; i < 2; ++i) f = stage.step({.command = Vec3(5, 0, 0)}, kPeriod).f;
  EXPECT_EQ(f.norm(), 0);
  EXPECT_TRUE(stage.latched());
  EXPECT_NE(stage.status() & kOutputNotFinite, 0u);
}

// Soft start: after half the time half the force.
TEST(OutputStage, StartsSoftly) {
  OutputStage stage(kLimits);
  Vec3 f = Vec3::Zero();
  for (int i = 0; i < 250; ++i) f = stage.step({.command = Vec3(4, 0, 0)}, kPeriod).f;
  EXPECT_NEAR(f.x(), 2, 1e-9);
}

// Old data: zero within the fade time; with new data, up again softly.
TEST(OutputStage, WatchdogFadesAndComesBack) {
  OutputStage stage(kLimits);
  settle(stage, {4, 0, 0});
  Vec3 f = Vec3::Zero();
  for (int i = 0; i < 21; ++i) f = stage.step({.command = Vec3(4, 0, 0), .trust = Trust::kFading}, kPeriod).f;
  EXPECT_EQ(f.norm(), 0);
  EXPECT_NE(stage.status() & kOutputWatchdog, 0u);
  EXPECT_NEAR(settle(stage, {4, 0, 0}).x(), 4, 1e-12);
}

// No sample, or contacts that are too old: down at the slew limit, 4 N in 4 ticks.
TEST(OutputStage, WhatIsDroppedGoesDownAsFastAsSlewAllows) {
  OutputStage stage(kLimits);
  settle(stage, {4, 0, 0});
  for (int i = 1; i <= 4; ++i) {
    EXPECT_NEAR(stage.step({.command = Vec3(4, 0, 0), .trust = Trust::kDropped}, kPeriod).f.x(), 4 - i, 1e-9);
  }
  EXPECT_NEAR(stage.step({.command = Vec3(4, 0, 0)}, kPeriod).f.x(), 4 * kPeriod / kLimits.soft_start,
              1e-9);  // softly again
}

// A sample that is late by no more than three ticks dips into the force: it comes back as fast as slew allows, and does
// not start anew.
TEST(OutputStage, AShortGapIsADip) {
  for (int gap = 1; gap <= 3; ++gap) {
    OutputStage stage(kLimits);
    settle(stage, {4, 0, 0});
    for (int i = 1; i <= gap; ++i) {
      EXPECT_NEAR(stage.step({.command = Vec3(4, 0, 0), .trust = Trust::kDropped}, kPeriod).f.x(), 4 - i, 1e-9);
      EXPECT_NE(stage.status() & kOutputFading, 0u);
    }
    for (int i = gap - 1; i >= 0; --i) EXPECT_NEAR(stage.step({.command = Vec3(4, 0, 0)}, kPeriod).f.x(), 4 - i, 1e-9);
    EXPECT_EQ(stage.status(), kOutputClean);
  }
}

// A lost device: to zero; only a re-arm brings the force back, softly, and not while the device is still lost.
TEST(OutputStage, ALostDeviceStaysAtZeroUntilRearmed) {
  OutputStage stage(kLimits);
  settle(stage, {4, 0, 0});
  for (int i = 0; i < 25; ++i) stage.step({.command = Vec3(4, 0, 0), .lost = i == 0}, kPeriod);
  EXPECT_EQ(settle(stage, {4, 0, 0}).norm(), 0);
  EXPECT_EQ(stage.status() & kOutputLatches, kOutputLost);
  stage.rearm();
  EXPECT_NEAR(stage.step({.command = Vec3(4, 0, 0)}, kPeriod).f.x(), 4 * kPeriod / kLimits.soft_start, 1e-9);
  EXPECT_NEAR(settle(stage, {4, 0, 0}).x(), 4, 1e-12);
  stage.step({.lost = true}, kPeriod);
  for (int i = 0; i < 100; ++i) {
    stage.rearm();
    stage.step({.command = Vec3(4, 0, 0), .lost = true}, kPeriod);
  }
  EXPECT_TRUE(stage.last() == Wrench());
}

// The other fingers' forces go to zero, too, with a status that names another finger.
// Its square overflows. It is as large as the limit, in the direction that was asked for.
TEST(OutputStage, AHugeCommandKeepsItsDirection) {
  OutputStage stage(kLimits);
  const Vec3 force = settle(stage, {3e200, 4e200, 0});
  EXPECT_NEAR(force.norm(), kLimits.force, 1e-9);
  EXPECT_NEAR(force.x() / force.y(), 0.75, 1e-12);
}

TEST(OutputStage, AnotherFingersLostDeviceLatchesToo) {
  OutputStage stage(kLimits);
  settle(stage, {4, 0, 0});
  stage.step({.command = Vec3(4, 0, 0), .other_lost = true}, kPeriod);
  EXPECT_EQ(settle(stage, {4, 0, 0}).norm(), 0);
  EXPECT_EQ(stage.status() & kOutputLatches, kOutputOther);
  EXPECT_STREQ(latchedFault(stage.status()), "the device of another finger is lost");
}

// 1.5 m/s along the force trips at the second sample; against it, where the device brakes the hand, never.
TEST(OutputStage, AHandThatIsDrivenTooFastTrips) {
  OutputLimits limits = kLimits;
  limits.speed = 1;
  OutputStage driven(limits), braked(limits);
  settle(driven, {4, 0, 0});
  settle(braked, {4, 0, 0});
  driven.step({.command = Vec3(4, 0, 0), .v_WH = {1.5, 0, 0}}, kPeriod);
  EXPECT_FALSE(driven.latched());  // one sample is noise
  driven.step({.command = Vec3(4, 0, 0), .v_WH = {1.5, 0, 0}}, kPeriod);
  EXPECT_EQ(driven.status() & kOutputLatches, kOutputSpeed);
  for (int i = 0; i < 100; ++i) braked.step({.command = Vec3(4, 0, 0), .v_WH = {-1.5, 0, 0}}, kPeriod);
  EXPECT_FALSE(braked.latched());
  EXPECT_NEAR(braked.last().f.x(), 4, 1e-12);
}

// 8 N on motors that bear 4 N: heat is 4 (1 - e^(-t/tau)), the limit begins to fall at 0.9 of it, t = -tau ln(1 -
// 0.9/4), and ends at 4 N. Tolerance: the soft start of 0.5 s, whose heat lacks (1 - 1/3) of 0.5 s.
TEST(OutputStage, WarmMotorsGiveNoMoreThanTheyBear) {
  OutputLimits limits = kLimits;
  limits.continuous = 4;
  limits.heating_time = 60;
  OutputStage stage(limits);
  double falls = 0;
  for (int i = 0; i < 600'000; ++i) {
    stage.step({.command = Vec3(8, 0, 0)}, kPeriod);
    if (falls == 0 && (stage.status() & kOutputWarm) != 0) falls = i * kPeriod;
  }
  EXPECT_NEAR(falls, -60 * std::log(1 - 0.9 / 4) + 0.5 * 2 / 3, 0.02);
  EXPECT_NEAR(stage.last().f.x(), 4, 0.01);  // for e^-10 of the way
  EXPECT_NEAR(stage.heat(), 1, 0.01);
}

// If the rig wants overload recorded, the force is not limited, and every tick reports it.
TEST(OutputStage, AnOverloadCanBeAnEventInsteadOfALimit) {
  OutputLimits limits = kLimits;
  limits.continuous = 4;
  limits.heating_time = 0.1;
  limits.records_overload = true;
  OutputStage stage(limits);
  EXPECT_NEAR(settle(stage, {6, 0, 0}).x(), 6, 1e-12);
  EXPECT_EQ(stage.status(), kOutputOverload);
  for (int i = 0; i < 100; ++i) stage.step({.command = Vec3(3, 0, 0)}, kPeriod);
  EXPECT_EQ(stage.status(), kOutputClean);
}

// A force within the limits passes unchanged to the bit.
TEST(OutputStage, LeavesAGoodCommandAlone) {
  OutputStage stage(kLimits);
  const Vec3 wanted(1.25, -0.3, 2.1);
  EXPECT_EQ(settle(stage, wanted), wanted);
  EXPECT_EQ(stage.status(), kOutputClean);
}

}  // namespace
}  // namespace presa
