// The drive against closed forms.
#include "devices/admittance/drive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace presa::admittance {
namespace {

constexpr double kPeriod = 1e-3;
const FingerImpedance kNoHand{.mass = 0, .stiffness = 0, .damping = 0};

Parameters quiet() {
  Parameters p;
  p.noise = 0;
  return p;
}

Drive driveWith(const Parameters& p, std::uint64_t seed = 1) { return {p, kPeriod, RandomStream(seed, "sensor")}; }

// Reference: F/B (1 - e^(-t B/M)) behind a first-order lag with w = 2 pi f. Both are solved exactly, so only rounding
// remains.
TEST(AdmittanceDrive, MovesFreelyAsItsVirtualMassBehindItsServo) {
  for (const double bandwidth : {20.0, 50.0, 400.0}) {
    Parameters p = quiet();
    p.bandwidth = bandwidth;
    p.centre = Vec3::Zero();
    p.half_travel = Vec3::Constant(10);
    const double force = 3, rate = p.viscosity / p.inertia, w = 2 * std::numbers::pi * bandwidth;
    for (const bool by_hand : {true, false}) {
      Drive drive = driveWith(p);
      if (!by_hand) drive.command({force, 0, 0});
      for (int i = 1; i <= 800; ++i) {
        drive.advance({kNoHand, Vec3::Zero(), Vec3::Zero(), Vec3(by_hand ? force : 0, 0, 0)});
        const double t = i * kPeriod;
        const double v = force / p.viscosity * (1 - (w * std::exp(-rate * t) - rate * std::exp(-w * t)) / (w - rate));
        ASSERT_NEAR(drive.velocity().x(), v, 1e-12) << bandwidth << " Hz at " << t;
        ASSERT_EQ(drive.velocity().y(), 0);
      }
    }
  }
}

// Bandwidth of the servo: a force oscillating at f acts on a mass without damper. The servo scales the mass's own
// motion by 1/sqrt(2) and delays it by 45 degrees at f. Tolerance: the sensor is sampled at 4 kHz and held, sinc(pi f
// h) and a lag of h/2: 1e-4 in amplitude and 0.25 % of a period at 20 Hz.
TEST(AdmittanceDrive, FollowsUpToTheBandwidthOfItsServo) {
  Parameters p = quiet();
  p.viscosity = 0;
  p.bandwidth = 20;
  p.half_travel = Vec3::Constant(10);
  Drive drive = driveWith(p);
  const double w = 2 * std::numbers::pi * p.bandwidth, amplitude = 10;
  double in_phase = 0, in_quadrature = 0;
  constexpr int kSettle = 500, kTicks = 2500;  // 40 full periods counted
  // of m r' = A cos(w t) from rest: r = A / (m w) sin(w t)
  for (int i = 0; i < kTicks; ++i) {
    const double t = i * kPeriod;
    if (i >= kSettle) {
      in_phase += drive.velocity().x() * std::sin(w * t);
      in_quadrature += drive.velocity().x() * std::cos(w * t);
    }
    // mean of the force over the period: the held force with the same impulse
    const double mean = amplitude * (std::sin(w * (t + kPeriod)) - std::sin(w * t)) / (w * kPeriod);
    drive.advance({kNoHand, Vec3::Zero(), Vec3::Zero(), Vec3(mean, 0, 0)});
  }
  const double scale = 2.0 / (kTicks - kSettle) / (amplitude / (p.inertia * w));
  EXPECT_NEAR(std::hypot(in_phase, in_quadrature) * scale, std::sqrt(0.5), 0.01);
  EXPECT_NEAR(std::atan2(-in_quadrature, in_phase) * 180 / std::numbers::pi, 45, 1);
}

// At rest against a wall of 2 N/mm, 4 N of the hand give a depth of 2 mm, and the sensor reads the wall force.
TEST(AdmittanceDrive, RestsWhereWallAndHandAreInBalance) {
  Drive drive = driveWith(quiet());
  const FingerImpedance hand{.mass = 0.1, .stiffness = 0, .damping = 20};
  for (int i = 0; i < 5000; ++i) {
    drive.command({-2000 * std::max(0.0, drive.position().x()), 0, 0});
    drive.advance({hand, Vec3::Zero(), Vec3::Zero(), Vec3(4, 0, 0)});
  }
  EXPECT_NEAR(drive.position().x(), 0.002, 1e-9);
  EXPECT_NEAR(drive.handForce().x(), 4, 1e-6);
  EXPECT_NEAR(drive.velocity().norm(), 0, 1e-9);
}

bool growsAt(double stiffness, const Parameters& p, const FingerImpedance& hand) {
  Drive drive = driveWith(p);
  drive.place({1e-6, 0, 0});  // a bilateral spring on the wall keeps the loop linear
  double early = 0, late = 0;
  for (int i = 0; i < 12'000; ++i) {
    drive.command({-stiffness * drive.position().x(), 0, 0});
    drive.advance({hand, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
    if (i >= 2000) (i < 7000 ? early : late) = std::max(i < 7000 ? early : late, std::abs(drive.position().x()));
    if (drive.position().norm() > 1e-3) return true;  // the end stops are far away, the speed limit is not
  }
  return late > early;
}

// Below the bound a disturbance decays, above it grows: the bound includes every delay of the loop.
TEST(AdmittanceDrive, StiffestWallIsWhereAPushStopsDying) {
  for (const double bandwidth : {20.0, 50.0, 200.0}) {
    for (const double hand_damping : {5.0, 40.0}) {
      Parameters p = quiet();
      p.bandwidth = bandwidth;
      const FingerImpedance hand{.mass = 0.1, .stiffness = 300, .damping = hand_damping};
      const double bound = stiffestWall(p, hand, kPeriod);
      EXPECT_FALSE(growsAt(0.98 * bound, p, hand)) << bandwidth << " Hz, " << hand_damping << " N s/m: " << bound;
      EXPECT_TRUE(growsAt(1.02 * bound, p, hand)) << bandwidth << " Hz, " << hand_damping << " N s/m: " << bound;
    }
  }
}

// Routh's criterion on M/w s^3 + (M + m + B/w) s^2 + (B + b) s + k + K with a servo so slow that sampling is
// negligible: k + K < w (M + m + B/w) (B + b) / M. Sampling takes 0.6 ms of the servo's 32 ms: 2 %, so 4 % is allowed,
// below only.
TEST(AdmittanceDrive, StiffestWallOfASlowServoIsRouths) {
  Parameters p = quiet();
  p.bandwidth = 5;
  const FingerImpedance hand{.mass = 0.1, .stiffness = 100, .damping = 20};
  const double w = 2 * std::numbers::pi * p.bandwidth;
  const double routh =
      w * (p.inertia + hand.mass + p.viscosity / w) * (p.viscosity + hand.damping) / p.inertia - hand.stiffness;
  const double bound = stiffestWall(p, hand, kPeriod);
  EXPECT_LT(bound, routh);
  EXPECT_GT(bound, 0.96 * routh);
}

// The speed of the virtual mass, the range of the sensor and the end stops are respected.
TEST(AdmittanceDrive, SaturatesAndStopsAtItsEnds) {
  Parameters p = quiet();
  p.max_speed = 0.5;
  p.half_travel = {0.3, 0.3, 0.3};
  Drive drive = driveWith(p);
  for (int i = 0; i < 3000; ++i) {
    drive.advance({kNoHand, Vec3::Zero(), Vec3::Zero(), Vec3(60, 80, 0)});
    ASSERT_LE(drive.velocity().norm(), 0.5 * (1 + 1e-12));
    ASSERT_LE(drive.position().cwiseAbs().maxCoeff(), 0.3);
  }
  EXPECT_EQ(drive.position().x(), 0.3);
  EXPECT_EQ(drive.velocity().norm(), 0);

  p.max_force = 5;
  p.max_speed = 10;
  p.half_travel = Vec3::Constant(10);
  Drive weak = driveWith(p);
  for (int i = 0; i < 5000; ++i) weak.advance({kNoHand, Vec3::Zero(), Vec3::Zero(), Vec3(50, 0, 0)});
  EXPECT_NEAR(weak.velocity().x(), 5 / p.viscosity, 1e-9);
}

// Sensor noise: the velocity of a mass with damper under held white noise of standard deviation s is an AR(1) process
// with a = e^(-h B/M) and gain (1 - a) s / B; its variance is ((1 - a) s / B)^2 / (1 - a^2). 400 s contain about 2000
// independent values: 5 % standard error, and a tolerance of 20 %. The servo (400 Hz) is much faster.
TEST(AdmittanceDrive, NoiseComesFromTheSeedAndHasItsSize) {
  Parameters p;
  p.noise = 0.5;
  p.bandwidth = 400;
  p.half_travel = Vec3::Constant(100);
  const auto path = [&](std::uint64_t seed) {
    Drive drive = driveWith(p, seed);
    double square = 0;
    for (int i = 0; i < 400'000; ++i) {
      drive.advance({kNoHand, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
      square += drive.velocity().x() * drive.velocity().x();
    }
    return square / 400'000;
  };
  const double a = std::exp(-Drive::kSample * p.viscosity / p.inertia), gain = (1 - a) * p.noise / p.viscosity;
  const double variance = path(3);
  EXPECT_NEAR(variance / (gain * gain / (1 - a * a)), 1, 0.2);
  EXPECT_EQ(variance, path(3));
  EXPECT_NE(variance, path(4));
}

}  // namespace
}  // namespace presa::admittance
