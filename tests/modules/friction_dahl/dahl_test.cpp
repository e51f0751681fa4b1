#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/alloc_lock_guard.h"
#include "tests/support/friction_track.h"

namespace presa {
namespace {

using test::FrictionTrack;

constexpr double kSigma = 2000, kMu = 0.6, kNormal = 2, kCoulomb = kMu * kNormal;  // [N/m], [-], [N], [N]

FrictionTrack track(double period = 1e-3) {
  return {R"(<dahl stiffness="2000"/>)",
          {.mu_static = kMu, .mu_dynamic = kMu, .normal_force = kNormal, .stiffness = 1000, .period = period}};
}

/// Force after the displacement x in one direction from the force f0, both against the motion: the integral of
/// dF/dx = sigma (1 - F / Fc).
double closedForm(double x, double f0) { return kCoulomb - (kCoulomb - f0) * std::exp(-kSigma * x / kCoulomb); }

// The step is exact for a constant velocity, so speeds and rates from slow to fast give the closed form. Rounding alone.
TEST(Dahl, FollowsItsClosedFormAtEveryRateAndSpeed) {
  for (const double period : {2e-3, 1e-3, 5e-4}) {
    for (const double speed : {1e-3, 0.02, 0.5}) {
      FrictionTrack finger = track(period);
      double x = 0, force = 0;
      for (int tick = 0; tick < 400; ++tick) {
        force = -finger.slide({speed, 0, 0}).x();
        x += speed * period;
        ASSERT_NEAR(force, closedForm(x, 0), 1e-12) << speed << " " << period;
      }
      // back again, from the force reached
      double back = 0;
      for (int tick = 0; tick < 400; ++tick) {
        const double f = finger.slide({-speed, 0, 0}).x();
        back += speed * period;
        ASSERT_NEAR(f, closedForm(back, -force), 1e-12) << speed << " " << period;
      }
    }
  }
}

// Work over a closed loop in the steady state, against its closed form. Oracle: twice the integral of the upper branch,
// which begins at -Fm = -Fc tanh(sigma a / Fc). The eighth loop is steady
// to 1e-11 (a cycle contracts by exp(-4 sigma a / Fc) = 0.036). The trapezium rule over 4000 steps of a smooth function: 1e-6.
TEST(Dahl, TakesTheWorkOfItsHysteresisAndGivesNone) {
  constexpr double kAmplitude = 5e-4;
  constexpr int kTicks = 4000;
  const double speed = 2 * kAmplitude / (kTicks * 1e-3);
  FrictionTrack finger = track();
  double work = 0;
  for (int cycle = 0; cycle < 8; ++cycle) {
    work = 0;
    for (const double sign : {1.0, -1.0}) {
      double last = finger.slide(Vec3::Zero()).x();
      for (int tick = 0; tick < kTicks; ++tick) {
        const double f = finger.slide({sign * speed, 0, 0}).x();
        work -= 0.5 * (f + last) * sign * speed * 1e-3;
        last = f;
      }
    }
  }
  const double q = kSigma * kAmplitude / kCoulomb, most = kCoulomb * std::tanh(q);
  const double loop = 2 * (2 * kCoulomb * kAmplitude - (kCoulomb + most) * kCoulomb / kSigma * (1 - std::exp(-2 * q)));
  EXPECT_NEAR(work / loop, 1, 1e-5);
}

TEST(Dahl, IsAsStrongInEveryDirection) {
  for (double heading = 0; heading < 6.28; heading += 0.3) {
    FrictionTrack finger = track();
    const Vec3 along(std::cos(heading), std::sin(heading), 0);
    Vec3 force = Vec3::Zero();
    for (int tick = 0; tick < 30; ++tick) force = finger.slide(1e-2 * along);
    EXPECT_NEAR((force + closedForm(3e-4, 0) * along).norm(), 0, 1e-12) << heading;
  }
}

// When the normal force falls, the bristle cannot hold more than the Coulomb force.
TEST(Dahl, YieldsWhenTheFingerIsLifted) {
  FrictionTrack finger = track();
  for (int tick = 0; tick < 100; ++tick) finger.slide({0.1, 0, 0});
  EXPECT_TRUE(finger.slipping());
  finger.press(0.1 * kNormal);
  EXPECT_NEAR(-finger.slide(Vec3::Zero()).x(), 0.1 * kCoulomb, 1e-12);
}

TEST(Dahl, NeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  FrictionTrack finger = track();
  const RealTimeGuard guard;
  for (int i = 0; i < 100; ++i) finger.slide({0.01, 0, 0});
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

}  // namespace
}  // namespace presa
