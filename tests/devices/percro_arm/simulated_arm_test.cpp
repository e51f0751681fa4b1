#include "devices/percro_arm/simulated_arm.h"

#include <gtest/gtest.h>

#include "framework/core/math/random.h"
#include "tests/devices/percro_arm/arm.h"

namespace presa::percro {
namespace {

constexpr double kPeriod = 1e-3;

Parameters withoutDryFriction() {
  Parameters p = paperArm();
  p.friction.coulomb[0] = p.friction.coulomb[1] = p.friction.coulomb[2] = 0;
  return p;
}

void settle(SimulatedArm& arm, const Vec3& force, double time = 2) {
  const TipLoad bolted{.held = true};
  for (int i = 0; i < time / kPeriod; ++i) {
    arm.command(force);
    arm.advance(bolted);
  }
}

// The commanded force acts at a bolted tip in every place and direction: J^T, K, gravity and springs agree. Tolerance 1
// %: the Jacobian is that of the joints, and the structure bends by up to 3 mm of 441.
TEST(PercroArm, TheTipFeelsTheCommandedForce) {
  RandomStream stream(1, "force");
  for (int i = 0; i < 20; ++i) {
    SimulatedArm arm(withoutDryFriction(), kGravity, kPeriod);
    arm.place({stream.uniform(0.5, 0.95), stream.uniform(-0.2, 0.2), stream.uniform(-0.2, 0.2)});
    const Vec3 force{stream.uniform(-2, 2), stream.uniform(-2, 2), stream.uniform(-2, 2)};
    settle(arm, force);
    EXPECT_LT((arm.tipForce() - force).norm(), 0.01 * force.norm());
  }
}

// Like the paper's measurement for figure 6: the tip is bolted, the motors push across, the encoders measure the
// displacement. Tolerance: one encoder step, 60 to 130 um.
TEST(PercroArm, EncodersSeeTheComplianceThatTheTipDoesNot) {
  for (const double length : {0.5, 0.75, 1.0}) {
    SimulatedArm arm(withoutDryFriction(), Vec3::Zero(), kPeriod);
    arm.place({length, 0, 0});
    const Vec3 start = arm.reportedPosition();
    settle(arm, {0, 3, 0});
    const double bent = (arm.reportedPosition() - start).y(), expected = 3 * paperArm().structure.compliance(length);
    EXPECT_NEAR(bent, expected, transverseStep(paperArm(), length) + 0.01 * expected);
    EXPECT_EQ(arm.state().x, Vec3(length, 0, 0));
  }
}

// Without forces the reported position is within the encoder steps of the tip position.
TEST(PercroArm, ReportsTheTipToWithinAStep) {
  RandomStream stream(2, "report");
  for (int i = 0; i < 500; ++i) {
    SimulatedArm arm(paperArm(), Vec3::Zero(), kPeriod);
    arm.place({stream.uniform(0.5, 0.95), stream.uniform(-0.2, 0.2), stream.uniform(-0.2, 0.2)});
    const Vec3 off = arm.reportedPosition() - arm.state().x;
    const double across = transverseStep(paperArm(), arm.state().x.norm()), along = axialStep(paperArm());
    EXPECT_LT(off.norm(), 0.5001 * std::hypot(across, along));
    EXPECT_EQ(arm.reportedVelocity(), Vec3::Zero());
  }
}

// In the worst place the paper's continuous force is held permanently, the peak force for a limited time.
TEST(PercroArm, GivesThePrintedForcesInTheWorstPlace) {
  const double length = 1.069, diagonal = 1 / std::numbers::sqrt2;
  SimulatedArm arm(withoutDryFriction(), Vec3::Zero(), kPeriod);
  arm.place({length, 0, 0});
  settle(arm, {0, 4 * diagonal, 4 * diagonal}, 200);
  EXPECT_NEAR(arm.tipForce().norm(), 4, 0.04);
  EXPECT_LE(arm.maxHeat(), 1);
  settle(arm, {0, 10 * diagonal, 10 * diagonal}, 0.1);
  EXPECT_LT(arm.tipForce().norm(), 5);  // hot: no peak torque left
  SimulatedArm cold(withoutDryFriction(), Vec3::Zero(), kPeriod);
  cold.place({length, 0, 0});
  settle(cold, {0, 10 * diagonal, 10 * diagonal}, 2);
  EXPECT_NEAR(cold.tipForce().norm(), 10, 0.1);
  EXPECT_GT(cold.minShare(), 0.99);
}

// A free arm neither sinks nor rises: the controller compensates its weight.
TEST(PercroArm, CarriesItsOwnWeight) {
  SimulatedArm arm(paperArm(), kGravity, kPeriod);
  for (const double length : {0.45, 0.75, 1.05}) {
    arm.place({length, 0.1, -0.1});
    const Vec3 start = arm.state().x;
    for (int i = 0; i < 2000; ++i) {
      arm.command(Vec3::Zero());
      arm.advance({.mass = 1e-3});
    }
    EXPECT_LT((arm.state().x - start).norm(), 5e-5) << length;  // initial lag of the current
  }
}

}  // namespace
}  // namespace presa::percro
