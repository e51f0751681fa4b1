#include "devices/percro_arm/homing.h"

#include <gtest/gtest.h>

#include "devices/percro_arm/switched_on.h"

namespace presa::percro {
namespace {

using Failure = Homing::Failure;
const Parameters kArm = paperArm();
const Vec3 kGravity{0, -9.81, 0};
const TipLoad kEmptyThimble{.mass = 0.02};

SwitchedOn switchedOn(std::uint64_t seed, const Markers& markers = {}) {
  RandomStream stream(seed, "power-up");
  return {kArm, kGravity, markers, stream};
}

// From wherever it stands and whatever its counters show: each zero to a count, as an edge lies anywhere between two; at
// the tip never faster than a hand that reaches.
TEST(PercroHoming, FindsTheZeroOfEveryJoint) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SwitchedOn awake = switchedOn(seed);
    const Homing& homing = awake.home(kEmptyThimble);
    ASSERT_TRUE(homing.done()) << seed << ": joint " << homing.failedJoint();
    EXPECT_LT(awake.zeroError().cwiseAbs().maxCoeff(), 1) << seed;
    EXPECT_LT(awake.fastest(), 0.3) << seed;
    // and the arm knows where it is: its own half step, and that of the zero
    const Vec3 tip = tipPosition(kArm.geometry, awake.arm().state().q);
    EXPECT_LT((awake.arm().reportedPosition() - tip).norm(),
              1.5 * std::hypot(transverseStep(kArm, tip.norm()), axialStep(kArm)));
  }
}

TEST(PercroHoming, GivesUpWhenAJointIsHeld) {
  SwitchedOn awake = switchedOn(1);
  EXPECT_EQ(awake.home({.held = true}).failure(), Failure::kBlocked);
  EXPECT_EQ(awake.homing().failedJoint(), 2);  // the barrel goes first
}

TEST(PercroHoming, GivesUpWhenThereIsNoMarker) {
  Markers markers;
  markers.at[2] = 5;  // fell off: never covered
  SwitchedOn awake = switchedOn(2, markers);
  EXPECT_NE(awake.home(kEmptyThimble).failure(), Failure::kNone);  // by the way gone, or by the stop at its end
  EXPECT_EQ(awake.homing().failedJoint(), 2);
  EXPECT_FALSE(awake.homing().done());
}

// A transmission that loses counts on the way, 0.6 mm a second, is not believed.
TEST(PercroHoming, NoticesASlippingTransmission) {
  SwitchedOn awake = switchedOn(3);
  for (int i = 0; i < 90'000 && !awake.homing().done() && awake.homing().failure() == Failure::kNone; ++i) {
    if (i % 100 == 0) awake.slip({0, 0, 1});
    awake.step(kEmptyThimble);
  }
  EXPECT_EQ(awake.homing().failure(), Failure::kUnsteady);
}

}  // namespace
}  // namespace presa::percro
