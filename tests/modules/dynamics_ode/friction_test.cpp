#include "tests/modules/dynamics_ode/support.h"
#include "tests/support/effort.h"

namespace presa::ode {
namespace {

const Vec3 kBlock(0.08, 0.08, 0.08);

// Direction down the slope, oblique to any axis with which a friction pyramid could be aligned.
const Vec3 kDown = turn(radians(37), Vec3::UnitZ()) * Vec3::UnitX();
double along(const Vec3& v) { return v.dot(kDown); }
double headingOf(const Vec3& v) { return degrees(std::atan2(v.dot(Vec3::UnitZ().cross(kDown)), along(v))); }

// A box on an inclined plane, with its edges rotated by `heading` about the normal. Gravity is tilted instead of the
// plane.
Runner onSlope(double slope_deg, double heading_deg, double mu_static, double mu_dynamic, double mass = 1) {
  const double a = radians(slope_deg);
  WorldMaker maker;
  maker.gravity(kGravity * (std::sin(a) * kDown - std::cos(a) * Vec3::UnitZ())).friction(mu_static, mu_dynamic);
  maker.fixedBox({20, 20, 0.1}, {{0, 0, -0.05}, turn(radians(17), Vec3::UnitZ())});
  maker.box(kBlock, mass, {{0, 0, 0.04}, turn(radians(heading_deg), Vec3::UnitZ())});
  return Runner(maker.world(), awake());
}

// Friction must not depend on the orientation of a box: ODE's own pyramid is 41 % too strong at 45 degrees and deflects
// the box by up to 34 degrees. Oracle: a = g (sin - mu cos), straight down.
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

// Started across the slope at 1.5 m/s, the slip direction changes. Oracle: a point mass with Coulomb friction, steps of
// 10 us.
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

// Oracle: Coulomb friction at the four corners of a box that slides and spins on the slope, in steps of 20 us. The
// normal forces at the corners follow from the balance of moments (friction acts below the centre of mass); of all
// solutions the most even one.
struct Slider {
  Vec3 v = Vec3::Zero();
  double spin = 0, heading = 0;
  void advance(double duration, double slope, double mu) {
    const double a = kBlock.x() / 2, height = kBlock.z() / 2, inertia = (4 * a * a + 4 * a * a) / 12, dt = 2e-5;
    const double load = kGravity * std::cos(slope);
    Vec3 friction = Vec3::Zero();  // per unit of mass
    for (int n = 0; n < std::lround(duration / dt); ++n) {
      Vec3 force = Vec3::Zero();
      double torque = 0;
      for (int corner = 0; corner < 4; ++corner) {
        const Vec3 r = turn(heading, Vec3::UnitZ()) * Vec3(corner & 1 ? a : -a, corner & 2 ? a : -a, 0);
        const double normal = std::max(0.0, load / 4 - height / (4 * a * a) * friction.dot(r));
        const Vec3 f = -mu * normal * (v + spin * Vec3::UnitZ().cross(r)).normalized();
        force += f;
        torque += r.cross(f).z();
      }
      friction = force;
      v += dt * (force + kGravity * std::sin(slope) * kDown);
      spin += dt * torque / inertia;
      heading += dt * spin;
    }
  }
};

TEST(Friction, SpinningBoxFollowsItsFourCornersForEveryHeading) {
  const double slope = radians(40), mu = 0.5;
  for (double heading = 0; heading <= 90; heading += 15) {
    Slider oracle;
    oracle.v = 0.5 * Vec3::UnitZ().cross(kDown);
    oracle.spin = 15;
    oracle.heading = radians(heading);
    Runner runner = onSlope(40, heading, mu, mu);
    runner.bodies.setVelocity(1, oracle.v, oracle.spin * Vec3::UnitZ());
    oracle.advance(0.5, slope, mu);
    runner.run(0.5);
    const Vec3 v = runner[1].v_WB;
    EXPECT_NEAR(v.norm(), oracle.v.norm(), 0.005 * oracle.v.norm()) << heading;
    EXPECT_NEAR(headingOf(v), headingOf(oracle.v), 0.2) << heading;
    // 2 % of the initial spin: first order in the step, in which the corners rotate by up to 4 degrees
    EXPECT_NEAR(runner[1].w_WB.z(), oracle.spin, 0.3) << heading;
  }
}

// A minute just below the friction angle: no measurable creep.
TEST(Friction, BoxDoesNotCreepInAMinute) {
  for (const double slope : {25.0, 26.5}) {
    Runner runner = onSlope(slope, 30, 0.5, 0.5);
    runner.run(0.2);
    const Vec3 settled = runner[1].X_WB_end.p;
    runner.run(unlessSanitized(60, 5));
    EXPECT_LT((runner[1].X_WB_end.p - settled).norm(), 1e-4) << slope;
  }
}

// SimBenchmark "rolling": 150 N drag a slab with 25 balls over the ground, 9 % above the static friction. Closed form:
// slab 0.7385 m/s2, balls 0.211 m/s2; error: mean over 4 s of the squared velocity errors of slab and first ball, 3.1
// (m/s)2 for ODE alone in direction xy. It starts in equilibrium: bodies that start 20 um inside each other are pushed
// apart, which adds to the normal force for one step and so to friction (8e-5).
TEST(Friction, SlabUnderRollingBallsAcceleratesByTheClosedForm) {
  for (const Vec3& direction : {Vec3(Vec3::UnitY()), Vec3(0.5, std::sqrt(0.75), 0)}) {
    const double inside = 1e-9;
    WorldMaker maker;
    maker.friction(0.2).fixedBox({200, 200, 1}, {{0, 0, -0.5}, Quat::Identity()});
    maker.friction(0.8).box({20, 20, 1}, 10, {{0, 0, 0.5 - inside}, Quat::Identity()});
    for (int i = 0; i < 25; ++i) {
      maker.add(Sphere{0.5}, {{2.0 * (i % 5 - 2), 2.0 * (i / 5 - 2), 1.5 - 3 * inside}, Quat::Identity()},
                {1, Vec3::Zero(), 0.1 * Mat3::Identity()});
    }
    World world = *maker.world();
    world.scene.bodies[1].force_W = 150 * direction;
    Runner runner(std::make_shared<World>(world), awake());
    const double on_ground = 0.4 * 35 * kGravity, on_ball = (150 - on_ground) / 10 / (3.5 + 2.5);
    const Vec3 slab = (150 - on_ground - 25 * on_ball) / 10 * direction, ball = on_ball * direction;
    double error = 0;
    constexpr int kSteps = unlessSanitized(4000, 400);
    for (int n = 1; n <= kSteps; ++n) {
      runner.step({}, 0.001);
      const double t = 0.001 * n;
      error += ((runner[1].v_WB - t * slab).squaredNorm() + (runner[2].v_WB - t * ball).squaredNorm()) / kSteps;
    }
    EXPECT_LT(error, 1e-6);
    RecordProperty("error", std::to_string(error));
  }
}

// Below the friction angle (26.565 degrees for mu 0.5) a box stays; above it slides.
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

// The static coefficient decides whether the box slides, the dynamic one how fast.
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

// Resting bodies penetrate the table imperceptibly, light or heavy. 10 um is a twentieth of a visible or perceptible
// depth.
TEST(Resting, PenetrationIsMicrons) {
  for (const double mass : {0.001, 0.2, 10.0}) {
    Runner runner(WorldMaker().table().box(kBlock, mass, {{0, 0, 0.0405}, Quat::Identity()}).world(), awake());
    runner.run(3);
    EXPECT_NEAR(runner[1].X_WB_end.p.z(), 0.04, 1e-5) << mass;
    EXPECT_LT(runner[1].v_WB.norm(), 1e-6) << mass;
    EXPECT_EQ(runner.bodies.contacts().size(), 4U);
    EXPECT_EQ(runner.bodies.fallbackSteps(), 0U);
  }
}

// A tower of five blocks stands.
TEST(Resting, StackStandsStill) {
  WorldMaker maker;
  maker.table();
  for (int i = 0; i < 5; ++i) maker.box(kBlock, 0.2, {{0, 0, 0.04 + 0.08 * i}, turn(0.2 * i, Vec3::UnitZ())});
  Runner runner(maker.world(), awake());
  runner.run(5);
  for (int i = 0; i < 5; ++i) {
    const BodyMotion& motion = runner[static_cast<std::size_t>(i) + 1];
    EXPECT_LT((motion.X_WB_end.p - Vec3(0, 0, 0.04 + 0.08 * i)).norm(), 1e-4);
    EXPECT_LT(motion.v_WB.norm(), 1e-5);
  }
}

// A finger drags a cube over a table: the cube moves in the finger's direction, whatever its orientation, because the
// finger's friction exceeds the table's.
TEST(Friction, DraggedCubeFollowsTheFinger) {
  for (const double heading : {0.0, 30.0, 45.0, 80.0}) {
    WorldMaker maker;
    maker.friction(0.2).table().box(kBlock, 0.2, {{0, 0, 0.04}, turn(radians(heading), Vec3::UnitZ())});
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
