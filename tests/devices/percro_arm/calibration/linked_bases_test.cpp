#include "devices/percro_arm/calibration/linked_bases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "framework/core/math/random.h"

namespace presa {
namespace {

Vec3 normal(RandomStream& stream) {
  const double x = stream.normal(), y = stream.normal();
  return {x, y, stream.normal()};
}

Pose anyPose(RandomStream& stream) {
  return {normal(stream), Quat(Eigen::AngleAxisd(stream.uniform(0, 3), normal(stream).normalized()))};
}

/// Points about 0.7 m in front of A, spread by `spread` along its axes, with noise.
std::vector<LinkedSample> samplesOf(RandomStream& stream, const Pose& X_AB, const Vec3& spread, double noise,
                                    int count = 400) {
  std::vector<LinkedSample> samples;
  for (int i = 0; i < count; ++i) {
    const Vec3 p = Vec3(0.7, 0, 0) + spread.cwiseProduct(normal(stream));
    samples.push_back({p + noise * normal(stream), X_AB.inverseTimes(p) + noise * normal(stream)});
  }
  return samples;
}

double angleBetween(const Pose& a, const Pose& b) { return 2 * (a.q.conjugate() * b.q).vec().norm(); }

// Without noise only rounding remains, for any pose of B; also for planar motions, which a mirror image fits as well.
TEST(LinkedBases, AreFoundExactlyWithoutNoise) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    RandomStream stream(seed, "exact");
    const Pose X_AB = anyPose(stream);
    for (const Vec3& spread : {Vec3(0.1, 0.08, 0.06), Vec3(0.1, 0.08, 0)}) {
      const LinkedBases fit = fitBases(samplesOf(stream, X_AB, spread, 0));
      ASSERT_EQ(fit.refusal, "");
      EXPECT_LT((fit.X_AB.p - X_AB.p).norm(), 1e-13);
      EXPECT_LT(angleBetween(fit.X_AB, X_AB), 1e-13);
      EXPECT_LT(fit.residual, 1e-14);
    }
  }
}

// The expected errors are standard errors: over many poses the squared errors must agree. 400 draws of three squares
// scatter by about 4 % (chi square); the tolerance of 15 % is more than three of these.
TEST(LinkedBases, MissByWhatTheyExpect) {
  double position = 0, angle = 0;
  constexpr int kSeeds = 400;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    RandomStream stream(seed, "noise");
    const Pose X_AB = anyPose(stream);
    const LinkedBases fit = fitBases(samplesOf(stream, X_AB, {0.1, 0.06, 0.04}, 50e-6));
    ASSERT_EQ(fit.refusal, "");
    position += std::pow((fit.X_AB.p - X_AB.p).norm() / fit.position_error, 2) / kSeeds;
    angle += std::pow(angleBetween(fit.X_AB, X_AB) / fit.angle_error, 2) / kSeeds;
  }
  EXPECT_NEAR(position, 1, 0.15);
  EXPECT_NEAR(angle, 1, 0.15);
}

// The condition number from its definition: points on a circle of radius r have moments r^2/2, r^2/2 and r^2 about
// their centre, scaled to arcs at 0.1 m; translations count 1.
TEST(LinkedBases, ConditionIsThatOfTheNormalEquations) {
  std::vector<LinkedSample> circle;
  for (int i = 0; i < 360; ++i) {
    const double t = i * std::numbers::pi / 180, r = 0.05;
    const Vec3 p(0.7, r * std::cos(t), r * std::sin(t));
    circle.push_back({p, p});
  }
  EXPECT_NEAR(fitBases(circle).condition, 1 / (0.5 * 0.05 * 0.05 / 0.01), 1e-9);
}

TEST(LinkedBases, AMotionAlongALineOrOnTheSpotIsRefused) {
  RandomStream stream(1, "poor");
  const Pose X_AB = anyPose(stream);
  for (const Vec3& spread : {Vec3(0.2, 1e-3, 1e-3), Vec3(5e-3, 5e-3, 5e-3), Vec3(0, 0, 0)}) {
    const LinkedBases fit = fitBases(samplesOf(stream, X_AB, spread, 30e-6));
    EXPECT_GT(fit.condition, kMaxCondition);
    EXPECT_NE(fit.refusal.find("too poor"), std::string::npos) << fit.refusal;
  }
  const LinkedBases line = fitBases(samplesOf(stream, X_AB, {0.2, 1e-3, 1e-3}, 0));
  EXPECT_NE(line.refusal.find("mm along one line"), std::string::npos) << line.refusal;
}

TEST(LinkedBases, WhatIsNoRigidMotionIsRefused) {
  RandomStream stream(2, "loose");
  const Pose X_AB = anyPose(stream);
  auto samples = samplesOf(stream, X_AB, {0.1, 0.1, 0.1}, 30e-6);
  for (LinkedSample& s : samples) s.p_B *= 1.05;  // a joint that is not homed scales the positions of its arm
  EXPECT_NE(fitBases(samples).refusal.find("did not hold one point"), std::string::npos);
  samples.resize(kMinSamples - 1);
  EXPECT_NE(fitBases(samples).refusal.find("too few"), std::string::npos);
  samples = samplesOf(stream, X_AB, {0.1, 0.1, 0.1}, 0);
  samples[7].p_A.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fitBases(samples).refusal, "a sample is no number");
}

}  // namespace
}  // namespace presa
