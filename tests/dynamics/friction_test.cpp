#include "tests/dynamics/support.h"

namespace presa::ode {
namespace {

const Vec3 kCube(0.08, 0.08, 0.08);

// Down the slope, oblique to every axis that a friction pyramid could happen to lie along.
const Vec3 kDown = turn(radians(37), Vec3::UnitZ()) * Vec3::UnitX();
double along(const Vec3& v) { return v.dot(kDown); }
double headingOf(const Vec3& v) { return degrees(std::atan2(v.dot(Vec3::UnitZ().cross(kDown)), along(v))); }

// A box on an inclined plane, its edges turned by `heading` about the normal. Gravity is tilted instead of the plane.
Runner onSlope(double slope_deg, double heading_deg, double mu_static, double mu_dynamic, double mass = 1) {
  const double a = radians(slope_deg);
  WorldMaker maker;
  maker.gravity(kGravity * (std::sin(a) * kDown - std::cos(a) * Vec3::UnitZ())).friction(mu_static, mu_dynamic);
  maker.fixedBox({20, 20, 0.1}, {{0, 0, -0.05}, turn(radians(17), Vec3::UnitZ())});
  maker.box(kCube, mass, {{0, 0, 0.04}, turn(radians(heading_deg), Vec3::UnitZ())});
  return Runner(maker.world());
}

// Friction must not depend on how a box lies: ODE's own pyramid is 41 % too strong at 45 degrees and pulls the
// box up to 34 degrees off its way. Oracle: a = g (sin - mu cos), straight down.
TEST(Friction, SlidingDownASlopeIsTheSameForEveryHeading) {
  const double a = radians(40), mu = 0.5;
  const double speed = kGravity * (std::sin(a) - mu * std::cos(a));
  for (double heading = 0; heading <= 90; heading += 7.5) {
    Runner runner = onSlope(40, heading, mu, mu);
    runner.run(1);
    const Vec3 v = runner[1].v_WB;
    EXPECT_NEAR(v.norm(), speed, 0.005 * speed) << heading;
    EXPECT_NEAR(headingOf(v), 0, 0.2) << heading;
  }
}

// Started across the slope at 1.5 m/s the slip turns. Oracle: a point mass with Coulomb friction, steps of 10 us.
TEST(Friction, TurningSlipFollowsThePointMassForEveryHeading) {
  const double a = radians(40), mu = 0.5;
  const Vec3 start = 1.5 * Vec3::UnitZ().cross(kDown);
  Vec3 v = start;
  for (int i = 0; i < 100000; ++i) {
    v += 1e-5 * kGravity * (std::sin(a) * kDown - mu * std::cos(a) * v.normalized());
  }
  for (double heading = 0; heading <= 90; heading += 15) {
    Runner runner = onSlope(40, heading, mu, mu);
    runner.bodies.setVelocity(1, start, Vec3::Zero());
    runner.run(1);
    const Vec3 w = runner[1].v_WB;
    EXPECT_NEAR(w.norm(), v.norm(), 0.005 * v.norm()) << heading;
    EXPECT_NEAR(headingOf(w), headingOf(v), 0.2) << heading;
  }
}

// Below the friction angle (26.565 degrees for mu 0.5) a box stays where it is; above, it goes.
TEST(Friction, BoxSticksBelowTheFrictionAngleWithoutCreep) {
  for (const double heading : {0.0, 30.0, 45.0}) {
    Runner runner = onSlope(26.4, heading, 0.5, 0.5);
    runner.run(0.2);
    const Vec3 settled = runner[1].X_WB_end.p;
    runner.run(10);
    EXPECT_LT((runner[1].X_WB_end.p - settled).norm(), 1e-4) << heading;
    Runner sliding = onSlope(26.8, heading, 0.5, 0.5);
    sliding.run(2);
    EXPECT_GT(along(sliding[1].X_WB_end.p), 0.01) << heading;
  }
}

// The static coefficient decides whether it goes, the dynamic one how fast.
TEST(Friction, StaticCoefficientHoldsAndDynamicBrakes) {
  Runner resting = onSlope(30, 20, 0.7, 0.3);
  resting.run(2);
  EXPECT_LT(resting[1].X_WB_end.p.head<2>().norm(), 1e-4);
  Runner pushed = onSlope(30, 20, 0.7, 0.3);
  pushed.bodies.setVelocity(1, 0.1 * kDown, Vec3::Zero());
  pushed.run(1);
  const double speed = 0.1 + kGravity * (std::sin(radians(30)) - 0.3 * std::cos(radians(30)));
  EXPECT_NEAR(along(pushed[1].v_WB), speed, 0.01 * speed);
}

// Bodies rest on the table with a penetration nobody sees, light or heavy. 10 um: a twentieth of what is seen or felt.
TEST(Resting, PenetrationIsMicrons) {
  for (const double mass : {0.001, 0.2, 10.0}) {
    Runner runner(WorldMaker().table().box(kCube, mass, {{0, 0, 0.0405}, Quat::Identity()}).world());
    runner.run(3);
    EXPECT_NEAR(runner[1].X_WB_end.p.z(), 0.04, 1e-5) << mass;
    EXPECT_LT(runner[1].v_WB.norm(), 1e-6) << mass;
    EXPECT_EQ(runner.bodies.contacts().size(), 4U);
    EXPECT_EQ(runner.bodies.fallbackSteps(), 0U);
  }
}

// A tower of five stays a tower.
TEST(Resting, StackStandsStill) {
  WorldMaker maker;
  maker.table();
  for (int i = 0; i < 5; ++i) maker.box(kCube, 0.2, {{0, 0, 0.04 + 0.08 * i}, turn(0.2 * i, Vec3::UnitZ())});
  Runner runner(maker.world());
  runner.run(5);
  for (int i = 0; i < 5; ++i) {
    const BodyMotion& motion = runner[static_cast<std::size_t>(i) + 1];
    EXPECT_LT((motion.X_WB_end.p - Vec3(0, 0, 0.04 + 0.08 * i)).norm(), 1e-4);
    EXPECT_LT(motion.v_WB.norm(), 1e-5);
  }
}

// A finger drags a cube over a table: the cube follows the finger's heading, whatever its own. It moves with the finger
// because mu N of the finger exceeds mu (N + m g) of the table only when the finger grips better.
TEST(Friction, DraggedCubeFollowsTheFinger) {
  for (const double heading : {0.0, 30.0, 45.0, 80.0}) {
    WorldMaker maker;
    maker.friction(0.2).table().box(kCube, 0.2, {{0, 0, 0.04}, turn(radians(heading), Vec3::UnitZ())});
    Runner runner(maker.world());
    std::vector<ReferenceFinger> fingers{{1, {0, 0, 0.04}, Vec3::UnitZ()}};
    fingers[0].damping = 1;
    const Vec3 start = Vec3(0, 0, 0.08 + ReferenceFinger::kRadius - 0.002);
    for (int n = 0; n < 400; ++n) {
      fingers[0].v_WH = Vec3(0.05, 0, 0);
      fingers[0].p_WH = start + runner.time * fingers[0].v_WH;
      runner.step(exchangeOf(fingers, runner));
    }
    EXPECT_NEAR(runner[1].v_WB.x(), 0.05, 1e-3) << heading;
    EXPECT_NEAR(runner[1].X_WB_end.p.y(), 0, 5e-4) << heading;
    const double load = 0.2 * kGravity - runner.bodies.fingerForce(0).z();
    EXPECT_NEAR(runner.bodies.fingerForce(0).head<2>().norm(), 0.2 * load, 0.01 * load) << heading;
  }
}

}  // namespace
}  // namespace presa::ode
