// Margin of a load at the present grip, and the min grip, against statics.
#include <gtest/gtest.h>

#include "tests/framework/grasp/grasps.h"

namespace presa::test {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

void expectAbout(const ProvenBounds& bounds, double exact) {
  EXPECT_LE(bounds.at_least, exact * (1 + 1e-9));  // rounding
  EXPECT_GE(bounds.at_most, exact * (1 - 1e-9));
  EXPECT_TRUE(bounds.met()) << bounds.at_least << " … " << bounds.at_most;
}

GraspSnapshot pressed(GraspSnapshot grasp, double normal) {
  for (GraspContact& contact : grasp.contacts) contact.max_normal = normal;
  return grasp;
}

TEST(Load, TwoOppositeFingersHoldAWeightByFriction) {
  for (const double mu : {0.2, 0.8}) {
    for (const double weight : {0.1, 1.962, 30.0}) {
      const Wrench load(Vec3(0, 0, -weight));
      expectAbout(loadFactor(pressed(pinchGrasp(mu), 6), load), 2 * mu * 6 / weight);
      expectAbout(minGrip(pinchGrasp(mu), load), weight / (2 * mu));
    }
  }
}

// The finger that presses less decides: both must push alike against each other.
TEST(Load, TheLighterOfTwoFingersDecides) {
  GraspSnapshot grasp = pressed(pinchGrasp(0.5), 6);
  grasp.contacts[1].max_normal = 2;
  expectAbout(loadFactor(grasp, Vec3(0, 0, -1)), 2 * 0.5 * 2);
}

// Faces that lean by `lean` so that the normals point upwards carry 2 N (sin + mu cos) upwards, sideways they cancel.
TEST(Load, LeaningFacesCarryPartOfTheWeight) {
  for (const double lean : {-0.3, 0.2, 0.5}) {
    const double mu = 0.6, normal = 3;
    GraspSnapshot grasp = pressed(pinchGrasp(mu), normal);
    for (GraspContact& contact : grasp.contacts)
      contact.inward = Vec3(std::cos(lean) * contact.inward.x(), 0, std::sin(lean));
    const double carried = 2 * (std::sin(lean) + mu * std::cos(lean));
    expectAbout(loadFactor(grasp, Vec3(0, 0, -1)), normal * carried);
    expectAbout(minGrip(grasp, Vec3(0, 0, -1)), 1 / carried);
  }
}

// n fingers around the body share an upright load.
TEST(Load, FingersAroundTheBodyShareIt) {
  for (const int fingers : {3, 4, 5}) {
    expectAbout(loadFactor(pressed(ringGrasp(fingers, 0.8), 6), Vec3(0, 0, -1.962)), fingers * 0.8 * 6 / 1.962);
    expectAbout(minGrip(ringGrasp(fingers, 0.8), Vec3(0, 0, -1.962)), 1.962 / (fingers * 0.8));
  }
}

// A push along the line meets one finger; a torque about the upright axis bends the grip with mu N on each arm.
TEST(Load, OtherLoadsThanTheWeight) {
  const GraspSnapshot grasp = pressed(pinchGrasp(0.5), 6);
  expectAbout(loadFactor(grasp, Vec3(2, 0, 0)), 3);
  expectAbout(loadFactor(grasp, {Vec3::Zero(), Vec3(0, 0, 1)}), 2 * 0.5 * 6);
}

// Torsion of soft fingers bears a torque about the line: 2 mu r N.
TEST(Load, SoftFingersBearATorqueAboutTheirLine) {
  const Wrench load(Vec3::Zero(), Vec3(0.01, 0, 0));
  expectAbout(loadFactor(pressed(pinchGrasp(0.8, 0.05), 6), load), 2 * 0.8 * 0.05 * 6 / 0.01);
  const ProvenBounds point = loadFactor(pressed(pinchGrasp(0.8), 6), load);
  EXPECT_EQ(point.at_most, 0);
  EXPECT_EQ(minGrip(pinchGrasp(0.8), load).at_least, kNever);
}

// A pinch beside the centre of mass: the weight turns the body. At 2 % of the length it hardly does, and the rest is
// held.
TEST(Load, AWeightThatTurnsTheBodyIsNotHeld) {
  GraspSnapshot grasp = pressed(pinchGrasp(0.8), 6);
  grasp.centre = Vec3(0, 0.02, -0.1);
  // the part that is left out is the square of what it turns
  EXPECT_NEAR(loadFactor(grasp, Vec3(0, 0, -1)).at_least, 9.6, 0.01 * 9.6);
  grasp.centre = Vec3(0, 0.2, -0.1);
  EXPECT_EQ(loadFactor(grasp, Vec3(0, 0, -1)).at_most, 0);
}

TEST(Load, FingersThatCannotLiftAndNoLoadAtAll) {
  const GraspSnapshot smooth = pressed(pinchGrasp(0), 6);
  EXPECT_EQ(loadFactor(smooth, Vec3(0, 0, -1)).at_most, 0);
  EXPECT_EQ(minGrip(smooth, Vec3(0, 0, -1)).at_least, kNever);
  EXPECT_EQ(loadFactor(pressed(pinchGrasp(0.5), 6), Wrench()).at_least, kNever);
}

// Faces that are not quite parallel, as rounding leaves them: the velocity across a normal is then pure rounding in
// some directions, which must not do work.
TEST(Load, RoundingOfTheNormalsDoesNoWork) {
  for (const double tilt : {1e-12, 5e-7, 1e-4}) {
    GraspSnapshot grasp;
    grasp.length = 0.035;
    grasp.contacts = {{Vec3(-0.043, 0, 0.005), Vec3(std::cos(tilt), 0, std::sin(tilt)), 0.8, 0, 6},
                      {Vec3(0.043, 0, 0.005), Vec3(-std::cos(tilt), 0, std::sin(tilt)), 0.8, 0, 6}};
    const double carried = 2 * (std::sin(tilt) + 0.8 * std::cos(tilt));
    // a thickness of the space below 1e-6 is left out
    const ProvenBounds factor = loadFactor(grasp, Vec3(0, 0, -1.962));
    EXPECT_NEAR(factor.at_least, 6 * carried / 1.962, 0.01 * factor.at_least) << tilt;
    EXPECT_GE(factor.at_most, 6 * carried / 1.962 * (1 - 1e-5)) << tilt;
    EXPECT_TRUE(factor.met()) << tilt << ' ' << factor.at_least << ' ' << factor.at_most;
  }
}

}  // namespace
}  // namespace presa::test
