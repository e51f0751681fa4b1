// The force of each law against its closed form, or a much finer integration of its differential equation.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/core/math/random.h"
#include "tests/support/friction_track.h"

namespace presa::curves {
namespace {

using test::FrictionTrack;

constexpr double kMuS = 0.8, kMuD = 0.5, kNormal = 2, kStiffness = 1000;  // [-], [-], [N], [N/m]
constexpr double kPeriods[] = {2e-3, 1e-3, 5e-4};                         // [s]
constexpr double kRounding = 1e-9;                                        // [N]

FrictionTrack track(const std::string& element, double period = 1e-3, double mu_s = kMuS, double mu_d = kMuD) {
  return {element,
          {.mu_static = mu_s, .mu_dynamic = mu_d, .normal_force = kNormal, .stiffness = kStiffness, .period = period}};
}

/// Force against the motion after `seconds` at a constant speed.
double steady(FrictionTrack&& finger, double speed, double period, double seconds = 1) {
  double force = 0;
  for (double t = 0; t < seconds; t += period) force = -finger.slide({speed, 0, 0}).x();
  return force;
}

/// Largest force against a slow slide.
double breakAway(FrictionTrack&& finger) {
  double most = 0;
  for (int i = 0; i < 20'000; ++i) most = std::max(most, -finger.slide({5e-4, 0, 0}).x());
  return most;
}

constexpr double kStep = kStiffness * 5e-4 * 1e-3;  // change of the force in one tick of breakAway [N]

double stribeck(double v, double v_s) { return kNormal * (kMuD + (kMuS - kMuD) * std::exp(-v * v / (v_s * v_s))); }

TEST(Viscous, AddsTheSameForceAtEveryRate) {
  for (const double period : kPeriods) {
    for (const double speed : {0.01, 0.1, 1.0}) {
      EXPECT_NEAR(steady(track(R"(<viscous damping="5"/>)", period), speed, period), kMuD * kNormal + 5 * speed,
                  kRounding);
      EXPECT_NEAR(steady(track(R"(<viscous damping="5"/>)", period, 0, 0), speed, period), 5 * speed, kRounding);
    }
  }
  EXPECT_NEAR(breakAway(track(R"(<viscous damping="5"/>)")), kMuS * kNormal, kStep);
}

// A viscosity that no sampled damper could render: B T / 2 is many times the mass of a finger.
TEST(Viscous, AtAnyViscosityTheForceStaysBelowTheSpringsAndFades) {
  FrictionTrack finger = track(R"(<viscous damping="1000"/>)", 1e-3, 0, 0);
  for (int i = 0; i < 10; ++i) EXPECT_LE(finger.slide({0.1, 0, 0}).norm(), kStiffness * 1e-4 * (i + 1));
  double last = 1;
  for (int i = 0; i < 5000; ++i) {
    const double force = -finger.slide(Vec3::Zero()).x();
    ASSERT_GE(force, 0);
    ASSERT_LE(force, last);
    last = force;
  }
  EXPECT_LT(last, 0.01);  // time constant B / k = 1 s: exp(-5)
}

/// The rule printed for the friction cone algorithm: the god-object moves towards the circle of the cone, by at most
/// `radius` in each tick [m]. Lag after `seconds` beyond the cone [m].
double printedRule(double radius, double speed, double period, double seconds) {
  double lag = 0;
  for (double t = 0; t < seconds; t += period) lag = std::max(0.0, lag + speed * period - radius);
  return lag;
}

// Why the law is not the printed rule. By hand: 0.05 mm of radius, a finger at 0.04 and 0.06 mm in a tick.
TEST(Viscous, PrintedRuleAddsNothingBelowItsRadiusAndGrowsWithoutBoundAbove) {
  EXPECT_EQ(printedRule(5e-5, 0.04, 1e-3, 1), 0);
  EXPECT_NEAR(printedRule(5e-5, 0.06, 1e-3, 1), 0.01, 1e-4);
  EXPECT_NEAR(printedRule(5e-5, 0.06, 1e-3, 2), 0.02, 1e-4);
  EXPECT_EQ(printedRule(5e-5, 0.06, 5e-4, 2), 0);  // and nothing of it is left at 2 kHz
  for (const double speed : {0.04, 0.06}) {
    EXPECT_NEAR(steady(track(R"(<viscous damping="5"/>)", 1e-3, 0, 0), speed, 1e-3), 5 * speed, kRounding);
  }
}

TEST(Stribeck, FollowsItsCurveAtEveryRate) {
  for (const double period : kPeriods) {
    for (const double v : {1e-3, 5e-3, 0.02, 0.05, 0.5}) {
      const double seconds = 0.05 + 0.005 / v;  // through the static cone, then ten time constants of the smoothing
      EXPECT_NEAR(steady(track(R"(<stribeck speed="0.02"/>)", period), v, period, seconds) / stribeck(v, 0.02), 1, 1e-4)
          << v << " " << period;
      EXPECT_NEAR(steady(track(R"(<stribeck speed="0.02" viscosity="2"/>)", period), v, period, seconds) /
                      (stribeck(v, 0.02) + 2 * v),
                  1, 1e-4)
          << v << " " << period;
    }
  }
  EXPECT_NEAR(breakAway(track(R"(<stribeck speed="0.02"/>)")), kMuS * kNormal, kStep);
}

// A device of 10 um, as the finger crosses 3 mm/s: one step in some three ticks. The speed of a tick is 0 or 10 mm/s.
TEST(Stribeck, IsNotDisturbedByQuantisedPositions) {
  FrictionTrack finger = track(R"(<stribeck speed="0.02"/>)");
  double last = 0, min = 10, max = 0;
  for (int i = 1; i < 3000; ++i) {
    const double x = 1e-5 * std::floor(i * 3e-6 / 1e-5);
    const double force = -finger.slide({(x - last) / 1e-3, 0, 0}).x();
    last = x;
    if (i < 2000) continue;
    min = std::min(min, force);
    max = std::max(max, force);
  }
  EXPECT_NEAR(min, stribeck(3e-3, 0.02), 0.03);
  EXPECT_NEAR(max, stribeck(3e-3, 0.02), 0.03);
}

struct Bristles {
  double sigma, v_s, damping, viscosity;
  std::string element() const {
    return "<lugre stiffness=\"" + std::to_string(sigma) + "\" speed=\"" + std::to_string(v_s) + "\" damping=\"" +
           std::to_string(damping) + "\" viscosity=\"" + std::to_string(viscosity) + "\"/>";
  }
  double rate(double v, double z) const { return v - sigma * std::abs(v) * z / stribeck(v, v_s); }
  double force(double v, double z) const { return sigma * z + damping * rate(v, z) + viscosity * v; }
  /// Runge-Kutta of fourth order, in `steps` steps.
  double after(double time, double v, double z, int steps) const {
    const double h = time / steps;
    for (int i = 0; i < steps; ++i) {
      const double a = rate(v, z), b = rate(v, z + h / 2 * a), c = rate(v, z + h / 2 * b), d = rate(v, z + h * c);
      z += h / 6 * (a + 2 * b + 2 * c + d);
    }
    return z;
  }
};
constexpr Bristles kBristles{2000, 0.01, 1, 0.8};

// Oracle: the differential equation in a hundred steps a tick, under a speed that changes from tick to tick.
TEST(LuGre, FollowsItsDifferentialEquationAtEveryRate) {
  for (const double period : kPeriods) {
    FrictionTrack finger = track(kBristles.element(), period);
    double z = 0;
    for (double t = 0; t < 2; t += period) {
      const double v = 0.02 * std::sin(12 * t) + 0.005 * std::sin(71 * t);
      z = kBristles.after(period, v, z, 100);
      ASSERT_NEAR(-finger.slide({v, 0, 0}).x(), kBristles.force(v, z), 1e-6) << t << " " << period;
    }
  }
}

// z tends to its steady value with the way slid; 20 mm are more than 20 times the longest bristle.
TEST(LuGre, SlidesSteadilyOnStribecksCurve) {
  for (const double v : {1e-3, 5e-3, 0.02, 0.2}) {
    EXPECT_NEAR(steady(track(kBristles.element()), v, 1e-3, 0.02 + 0.02 / v) / (stribeck(v, 0.01) + 0.8 * v), 1, 1e-3)
        << v;
  }
}

TEST(LuGre, BreaksAwayAtTheStaticCoefficientAndBeginsWithItsStiffness) {
  const Bristles slow{2000, 0.1, 0, 0};
  EXPECT_NEAR(breakAway(track(slow.element())) / (kMuS * kNormal), 1, 1e-3);
  FrictionTrack finger = track(slow.element());
  EXPECT_NEAR(-finger.slide({1e-4, 0, 0}).x(), 2000 * 1e-7, 2e-8);
}

TEST(LuGre, WithoutStribeckAndDampingIsDahls) {
  FrictionTrack lugre = track(R"(<lugre stiffness="2000" speed="0.01"/>)", 1e-3, kMuD, kMuD);
  FrictionTrack dahl = track(R"(<dahl stiffness="2000"/>)", 1e-3, kMuD, kMuD);
  RandomStream random(1, "lugre", 0);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 v(0.02 * random.normal(), 0.02 * random.normal(), 0);
    ASSERT_NEAR((lugre.slide(v) - dahl.slide(v)).norm(), 0, 1e-12) << i;
  }
}

// By hand: k_T l up to mu_s N, at l = mu_s N / k_T; then mu_d N. One step of the finger is the resolution.
TEST(Membrane, BreaksAwayWhereItsOwnStiffnessSays) {
  for (const double k_t : {250.0, 1000.0, 4000.0}) {
    FrictionTrack finger = track("<membrane stiffness=\"" + std::to_string(k_t) + "\"/>");
    double l = 0, force = 0;
    while (l < 0.01) {
      const double next = -finger.slide({5e-4, 0, 0}).x();
      if (next < force) break;
      l += 5e-7;
      force = next;
      ASSERT_NEAR(force, k_t * l, kRounding);
    }
    EXPECT_NEAR(l, kMuS * kNormal / k_t, 5e-7);
    for (int i = 0; i < 10'000; ++i) force = -finger.slide({5e-4, 0, 0}).x();
    EXPECT_TRUE(finger.slipping());
    EXPECT_NEAR(force, kMuD * kNormal, kRounding);
  }
}

TEST(Membrane, OfTheSurfacesOwnStiffnessIsTheCone) {
  FrictionTrack membrane = track(R"(<membrane stiffness="1000"/>)"), cone = track("");
  RandomStream random(1, "membrane", 0);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 v(random.normal(), random.normal(), 0);
    ASSERT_NEAR((membrane.slide(v) - cone.slide(v)).norm(), 0, kRounding) << i;
    ASSERT_EQ(membrane.slipping(), cone.slipping());
  }
}

// Maximum dissipation: of all forces in the ellipse the one that resists the slide most,
// N (mu_1^2 v_1, mu_2^2 v_2) / sqrt(mu_1^2 v_1^2 + mu_2^2 v_2^2). The stretch turns there while the finger slides.
TEST(Anisotropic, ResistsMostInEveryDirection) {
  for (double heading = 0; heading < 6.28; heading += 0.1) {
    FrictionTrack finger = track(R"(<anisotropic grain="0 2 0" across="0.3"/>)");
    const Vec3 v(std::cos(heading), std::sin(heading), 0), mu(0.3 * kMuD, kMuD, 0);
    const Vec3 expected = -kNormal * mu.cwiseProduct(mu).cwiseProduct(v) / mu.cwiseProduct(v).norm();
    Vec3 force = Vec3::Zero();
    for (int i = 0; i < 2000; ++i) force = finger.slide(0.05 * v);
    EXPECT_NEAR((force - expected).norm(), 0, 1e-6) << heading;
    EXPECT_TRUE(finger.slipping());
  }
}

TEST(Anisotropic, OfRatioOneIsTheCone) {
  FrictionTrack ellipse = track(R"(<anisotropic grain="1 1 0" across="1"/>)"), cone = track("");
  RandomStream random(1, "anisotropic", 0);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 v(random.normal(), random.normal(), 0);
    ASSERT_NEAR((ellipse.slide(v) - cone.slide(v)).norm(), 0, 1e-6) << i;
  }
}

}  // namespace
}  // namespace presa::curves
