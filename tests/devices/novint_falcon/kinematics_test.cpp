#include "devices/novint_falcon/kinematics.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "framework/core/math/random.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa::falcon {
namespace {

/// A random position of the grip: a cylinder around the axis.
Vec3 inWorkspace(RandomStream& random) {
  const double angle = random.uniform(0, 2 * std::numbers::pi), radius = 0.05 * std::sqrt(random.uniform());
  return {radius * std::cos(angle), radius * std::sin(angle), random.uniform(0.085, 0.165)};
}

// Check points from the device description, given to the micrometre.
TEST(FalconKinematics, CheckPointsOfTheDescription) {
  const std::pair<Counts, Vec3> points[]{
      {{0, 0, 0}, {0, 0, 134.602}},
      {{500, 500, 500}, {0, 0, 156.860}},
      {{-500, -500, -500}, {0, 0, 110.754}},
      {{1000, 1000, 1000}, {0, 0, 173.603}},
      {{-1000, -1000, -1000}, {0, 0, 89.611}},
      {{300, -200, 100}, {14.528, -11.579, 136.148}},
  };
  for (const auto& [counts, p_mm] : points) {
    const auto p = direct(thighAngles(counts));
    ASSERT_TRUE(p);
    EXPECT_NEAR((*p * 1e3 - p_mm).cwiseAbs().maxCoeff(), 0, 0.6e-3) << counts[0];
  }
}

TEST(FalconKinematics, OneCountIsAsMuchAsTheCapstanSays) {
  const ThighAngles step = thighAngles({1, 0, -1}) - thighAngles({0, 0, 0});
  EXPECT_NEAR(step[0], 0.63590e-3, 0.5e-8);
  EXPECT_EQ(step[1], 0);
  EXPECT_NEAR(step[2], -step[0], 1e-16);
  EXPECT_NEAR(thighAngles({0, 0, 0})[1] * 180 / std::numbers::pi, 35, 1e-13);
}

// Independent of the closed form: lay out one leg link by link, then compute its thigh angle.
TEST(FalconKinematics, InverseFindsTheThighThatALegWasLaidOutWith) {
  constexpr double a = 0.060, b = 0.1025, c = 0.01443, d = 0.01125, e = 0.01125, f = -0.025, r = 0.0400, s = -0.02309;
  constexpr double azimuths_deg[]{90 + 15, -30 + 15, -150 + 15};
  RandomStream random(1, "falcon legs");
  int reached = 0;
  while (reached < 20000) {
    const auto leg = static_cast<Eigen::Index>(random.below(3));
    const double theta1 = random.uniform(-0.3, 1.4), theta2 = theta1 + random.uniform(0.2, 2.8);
    const double theta3 = std::numbers::pi / 2 + random.uniform(-0.6, 0.6);
    const double shin = d + b * std::sin(theta3) + e;
    const Vec3 foot(a * std::cos(theta1) + shin * std::cos(theta2) - c, b * std::cos(theta3) - f,
                    a * std::sin(theta1) + shin * std::sin(theta2));
    const double azimuth = azimuths_deg[leg] * std::numbers::pi / 180;
    const Vec3 p = Eigen::AngleAxisd(azimuth, Vec3::UnitZ()) * (foot + Vec3(r, s, 0));
    const auto angles = inverse(p);
    if (!angles) continue;  // out of reach of another leg
    ++reached;
    // acos loses digits near a stretched leg: 1e-16 / sin(0.2)
    ASSERT_NEAR((*angles)[leg], theta1, 1e-14);
  }
}

TEST(FalconKinematics, ThereAndBackIsTheSamePlace) {
  RandomStream random(2, "falcon round trip");
  double worst = 0, worst_warm = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Vec3 p = inWorkspace(random);
    const auto angles = inverse(p);
    if (!angles || !inverseJacobian(p)) continue;
    const auto cold = direct(*angles),
               warm = direct(*angles, p + 1e-3 * Vec3(random.normal(), random.normal(), random.normal()));
    ASSERT_TRUE(cold && warm) << p.transpose();
    worst = std::max(worst, (*cold - p).norm());
    worst_warm = std::max(worst_warm, (*warm - p).norm());
  }
  EXPECT_LT(worst, 1e-10);
  EXPECT_LT(worst_warm, 1e-10);
}

TEST(FalconKinematics, TheWorkspaceIsReachedAllOver) {
  RandomStream random(3, "falcon workspace");
  for (int i = 0; i < 100'000; ++i) {
    const Vec3 p = inWorkspace(random);
    ASSERT_TRUE(inverseJacobian(p)) << p.transpose();
  }
}

// Central differences, h = 1e-6 m: truncation h^2 f'''/6 and rounding eps/h are both below 1e-8 of the entries (10
// rad/m).
TEST(FalconKinematics, JacobianIsTheDerivative) {
  RandomStream random(4, "falcon jacobian");
  constexpr double h = 1e-6;
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 p = inWorkspace(random);
    const auto jacobian = inverseJacobian(p);
    ASSERT_TRUE(jacobian);
    for (int axis = 0; axis < 3; ++axis) {
      const auto ahead = inverse(p + h * Vec3::Unit(axis)), behind = inverse(p - h * Vec3::Unit(axis));
      ASSERT_TRUE(ahead && behind);
      ASSERT_NEAR(((*ahead - *behind) / (2 * h) - jacobian->col(axis)).cwiseAbs().maxCoeff(), 0,
                  1e-7 * std::max(1.0, jacobian->cwiseAbs().maxCoeff()))
          << p.transpose();
    }
  }
}

TEST(FalconKinematics, AnglesThatBelongToNoPositionAreSaid) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(direct({nan, 0.6, 0.6}));
  EXPECT_FALSE(direct({0.6, inf, 0.6}));
  EXPECT_FALSE(direct(thighAngles({32767, -32768, 0})));
  EXPECT_FALSE(inverse({0, 0, 0.5}));
  EXPECT_FALSE(inverse({nan, 0, 0.1}));
  EXPECT_FALSE(inverse({0, 1e308, 1e308}));
}

// An invalid start must not prevent the search from finding the solution.
TEST(FalconKinematics, ABadStartIsForgiven) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec3& start : {Vec3(nan, 0, 0), Vec3(5, 5, 5), Vec3(0, 0, -0.1), Vec3(0, 0, 0)}) {
    const auto p = direct(thighAngles({300, -200, 100}), start);
    ASSERT_TRUE(p);
    EXPECT_NEAR((*p * 1e3 - Vec3(14.528, -11.579, 136.148)).cwiseAbs().maxCoeff(), 0, 0.6e-3);
  }
}

// For any counts that three encoders can send, the search ends: with a position that has these angles, or without a
// result.
TEST(FalconKinematics, AnyCountsAreAnsweredOrRefused) {
  RandomStream random(5, "falcon counts");
  for (int i = 0; i < 20'000; ++i) {
    Counts counts;
    for (auto& count : counts)
      count = static_cast<std::int32_t>(random.below(i % 2 == 0 ? 65536 : 4096)) - (i % 2 == 0 ? 32768 : 2048);
    const auto p = direct(thighAngles(counts));
    if (!p) continue;
    ASSERT_TRUE(p->allFinite());
    ASSERT_NEAR((*inverse(*p) - thighAngles(counts)).cwiseAbs().maxCoeff(), 0, 1e-13);
  }
}

// 249 counts per newton along z, by -10000 (dp/dtheta)^T f: the motors pull the thighs in to push the grip out.
TEST(FalconForce, CountsOfTheDescription) {
  const Vec3 p = *direct(thighAngles({0, 0, 0}));
  EXPECT_EQ(*motorCounts({0, 0, 1}, p), (Counts{-249, -249, -249}));
  EXPECT_EQ(*motorCounts({1, 0, 0}, p), (Counts{-193, 651, -458}));
  // saturation there: 16 N along z, 6.3 N along x
  EXPECT_EQ(*motorCounts({0, 0, 100}, p), (Counts{-4095, -4095, -4095}));
  EXPECT_LT((*motorCounts({6.2, 0, 0}, p))[1], 4095);
  EXPECT_EQ((*motorCounts({6.4, 0, 0}, p))[1], 4095);
}

// Virtual work: in any motion the work of the motors equals the work on the hand. Torque = -counts / 10000.
TEST(FalconForce, MotorsDoTheWorkOfTheForce) {
  RandomStream random(6, "falcon work");
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 p = inWorkspace(random), f(random.normal(), random.normal(), random.normal());
    const Counts counts = *motorCounts(f, p, 4095, 1e4);
    const Vec3 dp = 1e-6 * Vec3(random.normal(), random.normal(), random.normal());
    const Vec3 dtheta = *inverse(p + dp) - *inverse(p - dp);
    if (*std::max_element(counts.begin(), counts.end()) == 4095 ||
        *std::min_element(counts.begin(), counts.end()) == -4095)
      continue;
    const double work = Vec3(counts[0], counts[1], counts[2]).dot(dtheta) * -1e-4;
    // half a count per motor, and second order in dp
    ASSERT_NEAR(work, f.dot(2 * dp), 0.5e-4 * dtheta.cwiseAbs().sum() + 1e-6 * dp.norm());
  }
}

TEST(FalconForce, WhatIsNotFiniteIsRejected) {
  constexpr double bad[]{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::signaling_NaN(),
                         std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double value : bad) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 f(1, 1, 1), p(0, 0, 0.13);
      f[axis] = value;
      EXPECT_FALSE(motorCounts(f, p));
      p[axis] = value;
      EXPECT_FALSE(motorCounts({1, 1, 1}, p));
    }
  }
}

// Any 192 bits as a force: either rejected as not finite, or within the limit, in the requested direction (each motor
// within half a count of one common factor), and encodable in a packet.
TEST(FalconForce, AnyBitsAsAForceStayInRangeAndKeepTheDirection) {
  RandomStream random(7, "falcon bits");
  int finite = 0, limited = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    Vec3 f;
    for (int axis = 0; axis < 3; ++axis) {
      f[axis] = std::bit_cast<double>(random.bits());
      if (i % 2 == 0) f[axis] = std::ldexp(random.uniform(-1, 1), static_cast<int>(random.below(20)) - 10);
    }
    const Vec3 p = inWorkspace(random);
    const auto counts = motorCounts(f, p);
    ASSERT_EQ(counts.has_value(), f.allFinite());
    if (!counts) continue;
    ++finite;
    const double size = f.cwiseAbs().maxCoeff();
    const Vec3 unit = -1e4 * inverseJacobian(p)->transpose().inverse() * (f / size);
    const double full = unit.cwiseAbs().maxCoeff();
    const double factor = std::min(size, 4095 / full);
    limited += size > factor;
    for (int motor = 0; motor < 3; ++motor) {
      const auto m = static_cast<std::size_t>(motor);
      ASSERT_LE(std::abs((*counts)[m]), 4095);
      ASSERT_NEAR((*counts)[m], unit[motor] * factor, 0.5 + 1e-9);
    }
    const Packet packet = encode({.force = *counts});
    for (std::size_t b = 1; b <= 12; ++b) ASSERT_TRUE(packet[b] >= 0x41 && packet[b] <= 0x50);
  }
  EXPECT_GT(finite, 900'000);
  EXPECT_GT(limited, 200'000);
  EXPECT_GT(finite - limited, 200'000);
}

TEST(FalconForce, ALowerLimitIsKeptToo) {
  EXPECT_EQ(*motorCounts({0, 0, 1e300}, {0, 0, 0.1346}, 500), (Counts{-500, -500, -500}));
  EXPECT_EQ(*motorCounts({0, 0, 0}, {0, 0, 0.1346}), (Counts{0, 0, 0}));
}

TEST(FalconKinematics, RunsOnTheHapticThread) {
  std::int32_t sum = 0;
  const auto run = [&sum] {
    Vec3 p = kCentre;
    for (int i = 0; i < 100; ++i) {
      p = direct(thighAngles({i, -i, 2 * i}), p).value_or(kCentre);
      sum += motorCounts({1, 2, 3}, p).value_or(Counts{})[0];
    }
  };
  RealTimeGuard guard;
  run();
  EXPECT_EQ(guard.violations(), 0) << guard.first();
  EXPECT_NE(sum, 0);
}

}  // namespace
}  // namespace presa::falcon
