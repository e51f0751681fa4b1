#include "devices/percro_arm/kinematics.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>

#include "framework/core/math/random.h"
#include "tests/devices/percro_arm/arm.h"

namespace presa::percro {
namespace {

const Geometry& kGeometry = kArm.geometry;

/// Random joints within the arm's ranges.
Joints anywhere(RandomStream& stream) {
  return {stream.uniform(-kGeometry.tilt_range, kGeometry.tilt_range),
          stream.uniform(-kGeometry.yaw_range, kGeometry.yaw_range),
          stream.uniform(0, kGeometry.length_max - kGeometry.length_min)};
}

// Central differences with step h: error h^2 / 6 |p'''| + rounding 1e-16 / h, both below 1e-9 of L at h = 1e-5.
TEST(PercroKinematics, JacobianIsTheDerivativeOfThePosition) {
  RandomStream stream(1, "jacobian");
  for (int i = 0; i < 200; ++i) {
    const Joints q = anywhere(stream);
    const Mat3 j = jacobian(kGeometry, q);
    for (int k = 0; k < 3; ++k) {
      const Vec3 d = 1e-5 * Vec3::Unit(k);
      const Vec3 slope = (tipPosition(kGeometry, q + d) - tipPosition(kGeometry, q - d)) / 2e-5;
      EXPECT_LT((j.col(k) - slope).norm(), 1e-8 * slope.norm()) << "joint " << k + 1;
    }
  }
}

// The paper's eq. 3 prints -L cos q1 cos q2 in place of -L cos q1 sin q2: an error of the whole length at rest.
TEST(PercroKinematics, ThePrintedJacobianIsNotTheDerivative) {
  const Joints q = Joints::Zero();
  const double h = 1e-5;
  const Vec3 d{0, h, 0};
  const double slope = (tipPosition(kGeometry, q + d) - tipPosition(kGeometry, q - d)).x() / (2 * h);
  const double printed = -kGeometry.length_min * std::cos(q[0]) * std::cos(q[1]);
  EXPECT_NEAR(slope, 0, 1e-9);
  EXPECT_NEAR(jacobian(kGeometry, q)(0, 1), 0, 1e-15);
  EXPECT_NEAR(printed, -0.441, 1e-12);
}

// 1e-12: a few rounding errors of numbers below 2.
TEST(PercroKinematics, JointsAndPositionInvertEachOtherOverTheWorkspace) {
  RandomStream stream(2, "inverse");
  for (int i = 0; i < 1000; ++i) {
    const Joints q = anywhere(stream);
    EXPECT_LT((jointsAt(kGeometry, tipPosition(kGeometry, q)) - q).norm(), 1e-12);
    const Vec3 p{stream.uniform(0.45, 1), stream.uniform(-0.3, 0.3), stream.uniform(-0.3, 0.3)};
    EXPECT_LT((tipPosition(kGeometry, jointsAt(kGeometry, p)) - p).norm(), 1e-12);
  }
}

TEST(PercroKinematics, TheBarrelsFrameIsATurnWhoseFirstAxisPointsToTheTip) {
  RandomStream stream(3, "frame");
  for (int i = 0; i < 100; ++i) {
    const Joints q = anywhere(stream);
    const Mat3 r = barrelFrame(q);
    EXPECT_LT((r * r.transpose() - Mat3::Identity()).norm(), 1e-14);
    EXPECT_NEAR(r.determinant(), 1, 1e-14);
    const Mat3 by_axes = (Eigen::AngleAxisd(q[0], Vec3::UnitZ()) * Eigen::AngleAxisd(q[1], Vec3::UnitY())).matrix();
    EXPECT_LT((r - by_axes).norm(), 1e-14);
  }
}

TEST(PercroKinematics, TransmissionHasTheSignsOfTheMotors) {
  const Mat3 k = transmission(kGeometry);
  EXPECT_LT((k * transmissionInverse(kGeometry) - Mat3::Identity()).norm(), 1e-14);
  const Joints equal = transmissionInverse(kGeometry) * Vec3(1, 1, 0);
  EXPECT_EQ(equal[0], 0);  // equal motor angles: yaw only
  EXPECT_LT(equal[1], 0);
  const Joints opposite = transmissionInverse(kGeometry) * Vec3(-1, 1, 0);
  EXPECT_GT(opposite[0], 0);  // opposite motor angles: tilt only
  EXPECT_EQ(opposite[1], 0);
}

// Reference: the singular value decomposition.
TEST(PercroKinematics, GainsAreTheSingularValuesOfTheMotorJacobian) {
  RandomStream stream(4, "gains");
  for (int i = 0; i < 100; ++i) {
    const Joints q = anywhere(stream);
    const Mat3 motor_jacobian = jacobian(kGeometry, q) * transmissionInverse(kGeometry);
    const Vec3 values = Eigen::JacobiSVD<Mat3>(motor_jacobian).singularValues();
    Vec3 own = gains(kGeometry, q);
    std::sort(own.data(), own.data() + 3, std::greater<>());
    EXPECT_LT((own - values).norm(), 1e-12 * values[0]);
    EXPECT_NEAR(conditionNumber(kGeometry, q), values[0] / values[2], 1e-10);
  }
}

TEST(PercroKinematics, SingularitiesAreNamedWhereTheJacobianLosesRank) {
  const double quarter = std::numbers::pi / 2;
  EXPECT_EQ(singularityAt(kGeometry, {0.3, quarter, 0.2}), Singularity::kBarrelAlongTiltAxis);
  EXPECT_EQ(singularityAt(kGeometry, {0.3, 0.2, -kGeometry.length_min}), Singularity::kTipAtCentre);
  EXPECT_NEAR(jacobian(kGeometry, {0.3, quarter, 0.2}).determinant(), 0, 1e-15);
  EXPECT_NEAR(jacobian(kGeometry, {0.3, 0.2, -kGeometry.length_min}).determinant(), 0, 1e-15);
  EXPECT_TRUE(std::isinf(conditionNumber(kGeometry, {0, 0, -kGeometry.length_min})));
  RandomStream stream(5, "singular");
  for (int i = 0; i < 200; ++i) {
    const Joints q = anywhere(stream);
    EXPECT_EQ(singularityAt(kGeometry, q), Singularity::kNone);
    EXPECT_GT(std::abs(jacobian(kGeometry, q).determinant()), 0.1);  // L^2 cos q2 >= 0.149 m^2 within reach
  }
}

// Max motion within one count of both encoders, over all pairs of neighbouring counts.
TEST(PercroKinematics, TransverseStepIsTheWorstOfAllNeighbours) {
  for (const double length : {0.441, 0.7, 1.07}) {
    const Joints q{0, 0, length - kGeometry.length_min};
    const Vec3 p = tipPosition(kGeometry, q);
    double worst = 0;
    for (int a = -1; a <= 1; ++a) {
      for (int b = -1; b <= 1; ++b) {
        const Vec3 motors = kArm.motors.count() * Vec3(a, b, 0);
        worst = std::max(worst, (tipPosition(kGeometry, q + transmissionInverse(kGeometry) * motors) - p).norm());
      }
    }
    EXPECT_NEAR(worst, transverseStep(kArm, length), 1e-6 * worst);
  }
}

TEST(PercroKinematics, WristAnglesInvertTheThimblesFrame) {
  RandomStream stream(6, "wrist");
  for (int i = 0; i < 200; ++i) {
    const Joints q = anywhere(stream);
    const Vec3 wrist{stream.uniform(-3, 3), stream.uniform(-1.5, 1.5), stream.uniform(-3, 3)};
    EXPECT_LT((wristAt(q, thimbleFrame(q, wrist)) - wrist).norm(), 1e-12);
  }
  // at the singularity only the frame is recovered, not the angles
  const Mat3 frame = thimbleFrame(Joints::Zero(), {0.4, std::numbers::pi / 2, 0.3});
  EXPECT_LT((thimbleFrame(Joints::Zero(), wristAt(Joints::Zero(), frame)) - frame).norm(), 1e-9);
}

// The inferred parameters reproduce the figures they were inferred from; the resolution only to the paper's rounding,
// 1.3 %.
TEST(PercroParameters, GiveThePrintedFigures) {
  EXPECT_NEAR(transverseStep(kArm, 0.441), printed::kStepShort, 0.014 * printed::kStepShort);
  EXPECT_NEAR(transverseStep(kArm, 1.070), printed::kStepLong, 0.014 * printed::kStepLong);
  EXPECT_NEAR(kArm.structure.compliance(0.441), 1 / printed::kStiffShort, 1e-12);
  EXPECT_NEAR(kArm.structure.compliance(1.070), 1 / printed::kStiffLong, 1e-12);
  EXPECT_GT(kArm.structure.bend_linear, 0);
  EXPECT_GT(kArm.structure.bend_cubic, 0);
  EXPECT_NEAR(kArm.masses.counterweight * kArm.masses.counterweight_arm,
              kArm.masses.barrel * (1.070 - kArm.masses.barrel_setback), 1e-15);
}

}  // namespace
}  // namespace presa::percro
