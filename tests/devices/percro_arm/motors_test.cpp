#include "devices/percro_arm/motors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "devices/percro_arm/encoders.h"
#include "tests/devices/percro_arm/arm.h"

namespace presa::percro {
namespace {

// Closed form of a first-order lag after a step of the command; the mean over a period is its integral. Exact up to
// rounding.
TEST(PercroMotors, TorqueFollowsTheLagOfTheCurrentLoop) {
  MotorDrive drive(kArm.motors);
  drive.command(Vec3::Zero(), {0.1, 0, 0});
  const double w = 2 * std::numbers::pi * kArm.motors.current_bandwidth, h = 0.25e-3;
  for (int i = 0; i < 20; ++i) {
    const double from = i * h, to = from + h;
    const double mean = 0.1 * (1 - (std::exp(-w * from) - std::exp(-w * to)) / (w * h));
    EXPECT_NEAR(drive.step(h)[0], mean, 1e-15);
  }
}

// Peak torque heats a cold winding as (peak / continuous)^2 (1 - exp(-t / tau)); the limit starts to fall at 0.9 and
// ends at the continuous torque.
TEST(PercroMotors, PeakTorqueLastsUntilTheWindingIsHot) {
  MotorDrive drive(kArm.motors);
  const double ratio = kArm.motors.peak_torque / kArm.motors.continuous_torque, tau = kArm.motors.thermal_time;
  const double until = -tau * std::log(1 - 0.9 / (ratio * ratio)), h = 1e-3;
  double t = 0;
  while (true) {
    drive.command(Vec3::Zero(), {1, 0, 0});
    if (drive.limits()[0] < kArm.motors.peak_torque) break;
    drive.step(h), t += h;
  }
  EXPECT_NEAR(t, until, 5e-3);  // the lag of the current, 0.3 ms, and the tick
  for (; t < 20 * tau; t += h) {
    drive.command(Vec3::Zero(), {1, 0, 0});
    drive.step(h);
    ASSERT_LE(drive.heat()[0], 1 + 1e-9);
  }
  EXPECT_NEAR(drive.limits()[0], kArm.motors.continuous_torque, 1e-3 * kArm.motors.continuous_torque);
  EXPECT_EQ(drive.heat()[1], 0);
}

TEST(PercroMotors, SaturationKeepsTheDirectionOfTheForceAndWhatIsCarried) {
  MotorDrive drive(kArm.motors);
  const Vec3 carried{0.1, -0.05, 0.02}, wanted{2, 1, -0.5};
  const double share = drive.command(carried, wanted);
  EXPECT_NEAR(carried[0] + share * wanted[0], kArm.motors.peak_torque, 1e-15);
  for (int i = 0; i < 100; ++i) drive.step(1e-3);
  const Vec3 torque = drive.step(1e-3);
  EXPECT_LT((torque - carried - share * wanted).norm(), 1e-12);
  EXPECT_EQ(drive.command(carried, 0.01 * wanted), 1);
}

TEST(PercroEncoders, ReportWholeCountsAndTheNearest) {
  Encoders encoders(kArm);
  for (double t = 0; t < 1; t += 0.01) {
    const Joints q{0.3 * std::sin(9 * t), 0.2 * std::cos(7 * t), 0.3 + 0.1 * std::sin(5 * t)};
    encoders.sample(q);
    const Vec3 counts = transmission(kArm.geometry) * encoders.joints() / kArm.motors.count();
    EXPECT_LT((counts - Vec3(counts.array().round())).norm(), 1e-9);
    const Vec3 off = transmission(kArm.geometry) * (encoders.joints() - q) / kArm.motors.count();
    EXPECT_LE(off.cwiseAbs().maxCoeff(), 0.5 + 1e-9);
  }
}

// Steady motion: the slope over the longest window has an error of at most one count over 15 periods. At rest: zero.
TEST(PercroEncoders, RatesAreQuietWhenSlowAndTrueWhenFast) {
  const double period = 1e-3;
  for (const double speed : {0.003, 0.1, 1.0}) {
    Encoders encoders(kArm);
    encoders.reset({0, 0, 0.3});
    for (int i = 1; i < 200; ++i) {
      encoders.sample({0, 0, 0.3 + speed * i * period});
      const double error = std::abs(encoders.jointRates(period)[2] - speed);
      if (i > 40) {
        EXPECT_LE(error, 1.001 * axialStep(kArm) / (15 * period)) << speed;
      }
    }
    for (int i = 0; i < 16; ++i) encoders.sample(encoders.joints());
    EXPECT_EQ(encoders.jointRates(period), Vec3::Zero());
  }
}

}  // namespace
}  // namespace presa::percro
