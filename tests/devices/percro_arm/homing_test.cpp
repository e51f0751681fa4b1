#include "devices/percro_arm/homing.h"

#include <gtest/gtest.h>

#include "devices/percro_arm/switched_on.h"
#include "tests/devices/percro_arm/arm.h"

namespace presa::percro {
namespace {

using Failure = Homing::Failure;
const TipLoad kEmptyThimble{.mass = 0.02};

SwitchedOn switchedOn(std::uint64_t seed, const Markers& markers = {}) {
  RandomStream stream(seed, "power-up");
  return {kArm, kGravity, markers, stream};
}

// From any configuration and counter values each zero is found to a count (an edge may lie between two), at a tip speed
// no higher than a reaching hand's.
TEST(PercroHoming, FindsTheZeroOfEveryJoint) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SwitchedOn awake = switchedOn(seed);
    const Homing& homing = awake.home(kEmptyThimble);
    ASSERT_TRUE(homing.done()) << seed << ": joint " << homing.failedJoint();
    EXPECT_LT(awake.zeroError().cwiseAbs().maxCoeff(), 1) << seed;
    EXPECT_LT(awake.fastest(), 0.3) << seed;
    // and the reported position is correct to half an encoder step plus the error of the zero
    const Vec3 tip = tipPosition(kArm.geometry, awake.arm().state().q);
    EXPECT_LT((awake.arm().reportedPosition() - tip).norm(),
              1.5 * std::hypot(transverseStep(kArm, tip.norm()), axialStep(kArm)));
  }
}

TEST(PercroHoming, GivesUpWhenAJointIsHeld) {
  SwitchedOn awake = switchedOn(1);
  EXPECT_EQ(awake.home({.held = true}).failure(), Failure::kBlocked);
  EXPECT_EQ(awake.homing().failedJoint(), 2);  // the barrel is homed first
}

TEST(PercroHoming, GivesUpWhenThereIsNoMarker) {
  Markers markers;
  markers.at[2] = 5;  // lost marker: never covered
  SwitchedOn awake = switchedOn(2, markers);
  EXPECT_NE(awake.home(kEmptyThimble).failure(), Failure::kNone);  // by the travelled distance, or by the end stop
  EXPECT_EQ(awake.homing().failedJoint(), 2);
  EXPECT_FALSE(awake.homing().done());
}

// A transmission that slips by 0.6 mm per second is detected.
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
