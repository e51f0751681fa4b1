// Which grasps can resist every wrench, against conditions from geometry.
#include <gtest/gtest.h>

#include "tests/framework/grasp/grasps.h"

namespace presa::test {
namespace {

// Both point contacts lie on the line: no force of theirs has a torque about it.
TEST(Closure, TwoPointFingersLetTheBodyTurnAboutTheLineBetweenThem) {
  for (const double friction : {0.1, 0.8, 3.0}) {
    for (const GripBound bound : {GripBound::kSum, GripBound::kEach}) {
      const GraspQuality quality = graspQuality(pinchGrasp(friction), bound);
      EXPECT_EQ(quality.closure, GraspClosure::kPartial);
      EXPECT_EQ(quality.unopposed, 1);
      EXPECT_EQ(quality.epsilon.at_least, 0);  // exactly: from the rank, not from a small number
      EXPECT_EQ(quality.epsilon.at_most, 0);
      EXPECT_NEAR(std::abs(quality.weakest[3]), 1, 1e-9);  // rounding
    }
  }
}

/// Two fingers on parallel faces, the line between them `angle` off the normals.
GraspSnapshot skewPinch(double angle, double friction, double torsion) {
  GraspSnapshot grasp;
  const double aside = std::tan(angle);
  grasp.contacts = {{Vec3(-1, -aside, 0), Vec3::UnitX(), friction, torsion, 1},
                    {Vec3(1, aside, 0), -Vec3::UnitX(), friction, torsion, 1}};
  return grasp;
}

// [Nguyen1988]: two soft fingers hold against everything exactly if the line between them lies within both cones.
TEST(Closure, TwoSoftFingersNeedTheLineBetweenThemInBothCones) {
  for (const double friction : {0.2, 0.5, 1.0}) {
    const double cone = std::atan(friction);
    for (const double share : {0.0, 0.5, 0.99, 1.01, 1.5}) {
      const GraspClosure soft = graspQuality(skewPinch(share * cone, friction, 0.1), GripBound::kSum).closure;
      EXPECT_EQ(soft, share < 1 ? GraspClosure::kFull : GraspClosure::kNone) << friction << ' ' << share;
      const GraspClosure point = graspQuality(skewPinch(share * cone, friction, 0), GripBound::kSum).closure;
      EXPECT_EQ(point, share < 1 ? GraspClosure::kPartial : GraspClosure::kNone) << friction << ' ' << share;
    }
  }
}

// The same for faces at an angle: each cone is asked by itself.
TEST(Closure, TheLineMayLeaveNeitherCone) {
  RandomStream random(7, "closure");
  int in_both = 0;
  for (int i = 0; i < 200; ++i) {
    const double friction = random.uniform(0.2, 1);
    GraspSnapshot grasp = pinchGrasp(friction, 0.1);
    bool inside = true, clear = true;
    for (GraspContact& contact : grasp.contacts) {
      const Vec3 along = contact.inward;
      contact.inward = (along + random.uniform(0, 1) * anyUnit(random)).normalized();
      const double off = std::acos(contact.inward.dot(along)) / std::atan(friction);
      inside = inside && off < 1;
      clear = clear && std::abs(off - 1) > 0.01;  // nearer to the edge of the cone, the hull cannot tell
    }
    if (!clear) continue;
    in_both += inside ? 1 : 0;
    EXPECT_EQ(graspQuality(grasp, GripBound::kSum).closure, inside ? GraspClosure::kFull : GraspClosure::kNone) << i;
  }
  EXPECT_GT(in_both, 50);
  EXPECT_LT(in_both, 150);
}

// Fingers on one side push the body away, along the mean of their normals.
TEST(Closure, FingersOnOneSidePushTheBodyAway) {
  GraspSnapshot grasp;
  grasp.contacts = {{Vec3(-1, -0.5, 0), Vec3::UnitX(), 0.8, 0, 1}, {Vec3(-1, 0.5, 0), Vec3::UnitX(), 0.8, 0, 1}};
  const GraspQuality quality = graspQuality(grasp, GripBound::kSum);
  EXPECT_EQ(quality.closure, GraspClosure::kNone);
  EXPECT_EQ(quality.epsilon.at_most, 0);
  // the nearest wrench to 0 is found by steps that end at 1e-9 of its square
  EXPECT_GT(quality.weakest[0], 0.999);
}

// Without friction forces through one point have no torque: three motions of a ball are not opposed.
TEST(Closure, WithoutFrictionABallTurnsFreely) {
  const GraspQuality quality = graspQuality(tetrahedronGrasp(0), GripBound::kSum);
  EXPECT_EQ(quality.closure, GraspClosure::kPartial);
  EXPECT_EQ(quality.unopposed, 3);
  EXPECT_NEAR(quality.weakest.tail<3>().norm(), 1, 1e-9);
}

TEST(Closure, ASingleFingerHoldsNothing) {
  GraspSnapshot grasp = pinchGrasp(0.8, 0.1);
  grasp.contacts.pop_back();
  const GraspQuality quality = graspQuality(grasp, GripBound::kSum);
  EXPECT_EQ(quality.closure, GraspClosure::kNone);
  EXPECT_NEAR(quality.weakest[0], 1, 1e-4);
}

}  // namespace
}  // namespace presa::test
