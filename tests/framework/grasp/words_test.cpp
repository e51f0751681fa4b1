// Motions in words, as a person at the table would say them.
#include "framework/grasp/words.h"

#include <gtest/gtest.h>

#include "tests/framework/grasp/grasps.h"

namespace presa::test {
namespace {

const std::vector<std::string> kNames{"thumb", "index", "middle"};
const Vec3 kUp(0, 0, 9.81);

Vec6 motion(const Vec3& v, const Vec3& w) {
  Vec6 all;
  all << v, w;
  return all;
}

TEST(MotionWords, NameTurns) {
  const auto words = [](const GraspSnapshot& grasp, const Vec6& m) { return motionWords(grasp, m, kNames, kUp); };
  const Vec3 o = Vec3::Zero();
  EXPECT_EQ(words(pinchGrasp(1), motion(o, Vec3(-1, 0, 0))), "turns about the line between the fingers");
  EXPECT_EQ(words(pinchGrasp(1), motion(o, Vec3(0, 0, 1))), "turns about an upright axis through the centre of mass");
  EXPECT_EQ(words(pinchGrasp(1), motion(o, Vec3(0, -1, 0))),
            "turns about the axis (0.00, -1.00, 0.00) through the centre of mass");
  // an upright axis through (-1, 0, 0): the centre moves by z cross (1, 0, 0)
  EXPECT_EQ(words(pinchGrasp(1), motion(Vec3(0, 1, 0), Vec3(0, 0, 1))), "turns about an upright axis through thumb");
  EXPECT_EQ(words(pinchGrasp(1), motion(Vec3(0, 0, 0.5), Vec3(0, 0, 1))),
            "turns about an upright axis through the centre of mass and slides up");
}

TEST(MotionWords, NameTheLineOfTwoOfThreeFingers) {
  const GraspSnapshot grasp = ringGrasp(3, 1);
  const Vec3 line = grasp.contacts[2].p - grasp.contacts[1].p;
  EXPECT_EQ(motionWords(grasp, motion(line.cross(-grasp.contacts[1].p), line), kNames, kUp),
            "turns about the line between index and middle");
}

// A pinch above the centre of mass still lets the body turn about the line between the fingers.
TEST(MotionWords, NameTheLineThatMissesTheCentre) {
  GraspSnapshot grasp = pinchGrasp(0.8);
  grasp.centre = Vec3(0, 0, -0.4);
  EXPECT_EQ(motionWords(grasp, graspQuality(grasp, GripBound::kSum).weakest, kNames, kUp),
            "turns about the line between the fingers");
}

TEST(MotionWords, NameSlides) {
  const auto words = [](const Vec3& v) { return motionWords(pinchGrasp(1), motion(v, Vec3::Zero()), kNames, kUp); };
  EXPECT_EQ(words(Vec3(0, 0, 2)), "slides up");
  EXPECT_EQ(words(Vec3(0, 0.1, -2)), "slides down");
  EXPECT_EQ(words(Vec3(1, 0, 0)), "slides along the line between the fingers");
  EXPECT_EQ(words(Vec3(0, 1, 0)), "slides sideways along (0.00, 1.00, 0.00)");
  EXPECT_EQ(words(Vec3(0, 0.6, 0.8)), "slides along (0.00, 0.60, 0.80)");
  // nothing is up without gravity
  EXPECT_EQ(motionWords(pinchGrasp(1), motion(Vec3(0, 0, 1), Vec3::Zero()), kNames, Vec3::Zero()),
            "slides along (0.00, 0.00, 1.00)");
}

}  // namespace
}  // namespace presa::test
