#include <gtest/gtest.h>

#include <limits>

#include "framework/device/sample_check.h"

namespace presa {
namespace {

constexpr double kPeriod = 1e-3;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

FingerInput at(double x) { return {.p_WH = {x, 0, 0}, .v_WH = {0.1, 0, 0}, .valid = true}; }

TEST(SampleCheck, AGoodSamplePasses) {
  SampleCheck check;
  const FingerInput out = check.take(at(0.1), kPeriod);
  EXPECT_TRUE(out.valid);
  EXPECT_EQ(out.p_WH.x(), 0.1);
  EXPECT_EQ(out.v_WH.x(), 0.1);
}

// One bad sample: the last good position for one tick, at rest. The second in a row latches until a re-arm.
TEST(SampleCheck, TheSecondImpossibleSampleLatches) {
  for (const double bad : {kNan, std::numeric_limits<double>::infinity(), 1e308, 0.1 + 0.03}) {
    SampleCheck check;
    check.take(at(0.1), kPeriod);
    FingerInput out = check.take(at(bad), kPeriod);
    EXPECT_TRUE(out.valid) << bad;
    EXPECT_EQ(out.p_WH.x(), 0.1);
    EXPECT_EQ(out.v_WH.x(), 0);
    if (bad < 1) continue;  // a jump of 30 mm is possible within two ticks: see below
    out = check.take(at(bad), kPeriod);
    EXPECT_TRUE(out.lost);
    EXPECT_FALSE(check.take(at(0.1), kPeriod).valid);
    check.rearm();
    EXPECT_TRUE(check.take(at(0.7), kPeriod).valid);  // any position is accepted now
  }
}

/// A tool turned about x by `angle`, with a quaternion of this length.
FingerInput turned(double angle, double length = 1) {
  FingerInput input = at(0);
  input.oriented = true;
  input.q_WT = Quat(Eigen::AngleAxisd(angle, Vec3::UnitX()));
  input.q_WT.coeffs() *= length;
  input.w_WT = {1, 2, 3};
  return input;
}

// An orientation that is no rotation, not finite, or faster than 200 rad/s is rejected like an impossible position: the
// last good one for one tick, at rest; the second in a row latches.
TEST(SampleCheck, AnImpossibleOrientationIsRejected) {
  FingerInput wild = turned(0.1);
  wild.w_WT.z() = kNan;
  for (const FingerInput& bad : {turned(0.1, 1.01), turned(0.1, kNan), turned(0.1, 0), turned(0.1 + 0.21), wild}) {
    SampleCheck check;
    EXPECT_TRUE(check.take(turned(0.1), kPeriod).w_WT == Vec3(1, 2, 3));
    const FingerInput bridged = check.take(bad, kPeriod);
    EXPECT_TRUE(bridged.valid && bridged.oriented);
    EXPECT_EQ(bridged.q_WT.coeffs(), turned(0.1).q_WT.coeffs());
    EXPECT_TRUE(bridged.w_WT.isZero(0));
    EXPECT_FALSE(check.latched());
    check.take(turned(0.1, 0), kPeriod);
    EXPECT_TRUE(check.latched());
  }
  SampleCheck check;
  check.take(turned(0.1), kPeriod);
  EXPECT_TRUE(check.take(turned(0.1 + 0.19), kPeriod).w_WT == Vec3(1, 2, 3));  // 190 rad/s
  FingerInput opposite = turned(0.1 + 0.19);
  opposite.q_WT.coeffs() *= -1;  // the same orientation
  EXPECT_TRUE(check.take(opposite, kPeriod).w_WT == Vec3(1, 2, 3));
}

// 20 m/s is the bound: a jump is judged by the time since the last good sample.
TEST(SampleCheck, AJumpIsJudgedByTheTimeThatItHad) {
  SampleCheck check;
  check.take(at(0), kPeriod);
  EXPECT_EQ(check.take(at(0.019), kPeriod).p_WH.x(), 0.019);
  EXPECT_EQ(check.take(at(0.040), kPeriod).p_WH.x(), 0.019);  // 21 m/s
  EXPECT_EQ(check.take(at(0.040), kPeriod).p_WH.x(), 0.040);  // 10.5 m/s over two ticks
  EXPECT_FALSE(check.latched());
}

// A missing sample is bridged for one tick; then the finger is not valid and keeps its last position.
TEST(SampleCheck, ASilentDeviceIsBridgedForOneTick) {
  SampleCheck check;
  check.take(at(0.1), kPeriod);
  const FingerInput nothing;
  EXPECT_TRUE(check.take(nothing, kPeriod).valid);
  const FingerInput out = check.take(nothing, kPeriod);
  EXPECT_FALSE(out.valid);
  EXPECT_FALSE(out.lost);
  EXPECT_EQ(out.p_WH.x(), 0.1);
  EXPECT_TRUE(check.take(at(0.101), kPeriod).valid);  // valid again without a re-arm
}

// A sample that is already old when it comes counts as missing.
TEST(SampleCheck, AnOldSampleIsNone) {
  SampleCheck check;
  check.take(at(0.1), kPeriod);
  FingerInput old = at(0.1);
  old.age = 3e-3;
  EXPECT_TRUE(check.take(old, kPeriod).valid == false);
}

TEST(SampleCheck, BeforeTheFirstSampleNothingIsValid) {
  SampleCheck check;
  EXPECT_FALSE(check.take(FingerInput{}, kPeriod).valid);
  EXPECT_FALSE(check.take(at(kNan), kPeriod).valid);
}

TEST(SampleCheck, ADeviceThatSaysItIsLostStaysSo) {
  SampleCheck check;
  check.take(at(0.1), kPeriod);
  FingerInput lost;
  lost.lost = true;
  EXPECT_FALSE(check.take(lost, kPeriod).valid);
  EXPECT_TRUE(check.take(at(0.1), kPeriod).lost);
}

}  // namespace
}  // namespace presa
