#include "devices/falcon_model/legs.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>

#include "devices/falcon_model/force_watch.h"
#include "framework/core/math/random.h"

namespace presa::falcon_model {
namespace {

Vec3 thighsOf(const Vec3& counts) { return Vec3::Constant(kThighAtZero) + kThighPerCount * counts; }

/// A random point well inside the reach of all legs.
Vec3 somewhere(RandomStream& random) {
  return {random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03), random.uniform(0.08, 0.14)};
}

// Computed from the leg's joint angles with numpy, to six digits.
TEST(Legs, MeetTheCheckPoints) {
  struct Point {
    Vec3 counts, p_mm;
  };
  const std::array points{Point{{0, 0, 0}, {0, 0, 134.602428}},
                          Point{{500, 500, 500}, {0, 0, 156.860469}},
                          Point{{-500, -500, -500}, {0, 0, 110.754499}},
                          Point{{1000, 1000, 1000}, {0, 0, 173.603247}},
                          Point{{-1000, -1000, -1000}, {0, 0, 89.6105982}},
                          Point{{300, -200, 100}, {14.52758682, -11.57851388, 136.14777999}}};
  for (const Point& point : points) {
    const auto p_D = gripAt(thighsOf(point.counts), {0, 0, 0.11});
    ASSERT_TRUE(p_D);
    EXPECT_LT((*p_D * 1e3 - point.p_mm).norm(), 1e-6) << point.counts.transpose();
  }
}

// From the same source: counts for one newton at 10000 counts per N m.
TEST(Legs, CountsForANewtonAreThoseOfTheCheckPoint) {
  const Vec3 p_D = *gripAt(thighsOf(Vec3::Zero()), {0, 0, 0.11});
  const Mat3 rates = thighRates(p_D, thighsOf(Vec3::Zero()));
  const auto countsFor = [&](const Vec3& force) -> Vec3 {
    return rates.transpose().inverse() * force / kTorquePerCount;
  };
  EXPECT_LT((countsFor({0, 0, 1}) - Vec3::Constant(-249.383959)).norm(), 1e-5);
  EXPECT_LT((countsFor({1, 0, 0}) - Vec3(-193.04328, 650.75329, -457.71001)).norm(), 1e-4);
}

TEST(Legs, ThereAndBackIsTheSamePlace) {
  RandomStream random(1, "legs");
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p_D = somewhere(random);
    const auto thighs = thighsAt(p_D);
    ASSERT_TRUE(thighs) << p_D.transpose();
    const auto back = gripAt(*thighs, p_D + Vec3(0.003, -0.003, 0.003));
    ASSERT_TRUE(back);
    EXPECT_LT((*back - p_D).norm(), 1e-12);  // a few rounding errors, divided by the smallest slope of a torus
  }
}

// Central differences with 1e-6 m: their error is h^2 f'''/6, about 1e-8 of the rate here, plus rounding 1e-16/h.
TEST(Legs, RatesAreTheDerivativeOfTheAngles) {
  RandomStream random(2, "legs");
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 500; ++i) {
    const Vec3 p_D = somewhere(random);
    const Mat3 rates = thighRates(p_D, *thighsAt(p_D));
    for (int k = 0; k < 3; ++k) {
      const Vec3 h = kStep * Vec3::Unit(k);
      const Vec3 slope = (*thighsAt(p_D + h) - *thighsAt(p_D - h)) / (2 * kStep);
      EXPECT_LT((rates.col(k) - slope).norm(), 1e-6 * (1 + rates.norm()));
    }
  }
}

TEST(Legs, OutOfReachIsNoPlace) {
  EXPECT_FALSE(thighsAt({0, 0, 0.4}));
  EXPECT_FALSE(thighsAt({0.3, 0, 0.12}));
}

}  // namespace
}  // namespace presa::falcon_model
