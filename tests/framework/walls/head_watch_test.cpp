#include "framework/walls/head_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace presa::walls {
namespace {

constexpr double kPeriod = 1.0 / 60;

/// Tracks a head that stands at `pose` from `begin` to `end` [s]; returns the longest way of one step [m].
double track(HeadWatch& head, const Pose& pose, bool valid, double begin, double end) {
  double longest = 0;
  for (double time = begin; time < end; time += kPeriod) {
    const Vec3 before = head.pose().p;
    longest = std::max(longest, (head.update(pose, valid, time).p - before).norm());
  }
  return longest;
}

const Pose kHere{{0, -1, 1.7}, Quat::Identity()};
const Pose kThere{{0.6, -0.2, 1.7}, Quat(Eigen::AngleAxisd(1, Vec3::UnitZ()))};
// the fastest step of a minimum-jerk movement: its peak speed is 15/8 of the mean one
const double kFastestStep = (kThere.p - kHere.p).norm() * 15.0 / 8 / HeadWatch::kReturn * kPeriod;

TEST(HeadWatch, FollowsTheTrackerToTheBit) {
  HeadWatch head(kHere);
  track(head, kHere, true, 0, 2);
  const Pose near{{0.01, -1, 1.7}, Quat(Eigen::AngleAxisd(0.01, Vec3::UnitX()))};
  EXPECT_EQ(head.update(near, true, 2).p, near.p);
  EXPECT_FALSE(head.lost());
  EXPECT_EQ(head.losses(), 0u);
}

TEST(HeadWatch, FreezesWhenTheTrackerIsLostAndComesBackWithoutAJump) {
  HeadWatch head(kHere);
  track(head, kHere, true, 0, 2);
  EXPECT_EQ(track(head, kThere, false, 2, 3), 0);
  EXPECT_TRUE(head.lost());
  EXPECT_EQ(head.losses(), 1u);
  EXPECT_EQ(head.pose().p, kHere.p);
  EXPECT_LE(track(head, kThere, true, 3, 5), kFastestStep);
  EXPECT_FALSE(head.lost());
  EXPECT_EQ(head.pose().p, kThere.p);
  EXPECT_LT(head.pose().q.angularDistance(kThere.q), 1e-9);
}

TEST(HeadWatch, AMissedSampleIsNoLoss) {
  HeadWatch head(kHere);
  track(head, kHere, true, 0, 2);
  head.update(kHere, false, 2);
  EXPECT_FALSE(head.lost());
  head.update(kHere, true, 2 + kPeriod);
  EXPECT_EQ(head.losses(), 0u);
}

TEST(HeadWatch, AMeasuredJumpIsWalked) {
  HeadWatch head(kHere);
  track(head, kHere, true, 0, 2);
  EXPECT_LE(track(head, kThere, true, 2, 4), kFastestStep);
  EXPECT_EQ(head.pose().p, kThere.p);
}

TEST(HeadWatch, ImpossibleSamplesAreNone) {
  HeadWatch head(kHere);
  track(head, kHere, true, 0, 2);
  Pose bad = kThere;
  bad.p.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(head.update(bad, true, 3).p, kHere.p);
  bad = kThere;
  bad.q.coeffs() *= 2;
  EXPECT_EQ(head.update(bad, true, 3.1).p, kHere.p);
  EXPECT_TRUE(head.lost());
}

}  // namespace
}  // namespace presa::walls
