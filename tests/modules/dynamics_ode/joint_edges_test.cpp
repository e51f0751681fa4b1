#include "modules/dynamics_ode/contact_solver/newton_solver.h"
#include "modules/dynamics_ode/contact_solver/small_steps.h"
#include "modules/dynamics_ode/rotation.h"
#include "tests/modules/dynamics_ode/support.h"
#include "tests/support/alloc_lock_guard.h"

// Joints beside bouncing, sleep, held and put bodies, and the engine's own solvers.
namespace presa::ode {
namespace {

using JointEdge = testing::Test;

double angleAbout(const Vec3& axis, const Quat& q) { return turnBetween(Quat::Identity(), q).dot(axis); }

// That something in the scene bounces changes nothing for a drawer on a spring: the trapezoidal rule, as in
// Joint.SpringOfASliderKeepsPeriodAndAmplitude.
TEST(JointEdge, DrawerOnASpringKeepsItsAmplitudeWhereBodiesBounce) {
  const double mass = 0.5, stiffness = 50;
  WorldMaker maker;
  maker.gravity(Vec3::Zero()).bouncing(0.3).box(kCube, mass, {});
  maker.joint(JointType::kSlider, Vec3::Zero(), {Vec3::UnitX()}).axes[0].stiffness = stiffness;
  Runner runner(maker.world(), awake());
  runner.bodies.setVelocity(0, {0.1, 0, 0}, Vec3::Zero());
  const double step = 2 * std::atan(kStep * std::sqrt(stiffness / mass) / 2), c = kStep * 0.1 / std::sin(step);
  double worst = 0;
  for (int n = 1; n <= 2000; ++n) {
    runner.step();
    worst = std::max(worst, std::abs(runner[0].X_WB_end.p.x() - c * std::sin(n * step)));
  }
  EXPECT_LT(worst, 1e-6 * c);
}

TEST(JointEdge, DoorStaysOnItsHingeWhereBodiesBounce) {
  WorldMaker maker;
  maker.gravity(Vec3::Zero()).bouncing(0.3).box({0.3, 0.02, 0.1}, 0.5, {{0.15, 0, 0}, Quat::Identity()});
  maker.joint(JointType::kHinge, {-0.15, 0, 0}, {Vec3::UnitZ()});
  Runner runner(maker.world(), awake());
  runner.bodies.setVelocity(0, {0, 0.15 * 7, 0}, {0, 0, 7});
  double gap = 0;
  for (int n = 1; n <= 400; ++n) {
    runner.step();
    gap = std::max(gap, (runner[0].X_WB_end * Vec3(-0.15, 0, 0)).norm());
  }
  EXPECT_LT(gap, 1e-13);
}

/// A hinged pair, as the solvers get it.
struct HingedPair {
  HingedPair() {
    WorldMaker maker;
    maker.gravity(Vec3::Zero()).box(kCube, 0.1, {}).box(kCube, 0.1, {{0.1, 0, 0}, Quat::Identity()});
    maker.joint(JointType::kHinge, {-0.05, 0, 0}, {Vec3::UnitY()}, 0).axes[0].friction = 1e-3;
    world = maker.world();
    for (const double x : {0.0, 0.1}) {
      ContactProblem::Body& body = problem.bodies.emplace_back();
      body.p_WCm = {x, 0, 0};
      body.mass = 0.1;
      body.inertia_B = boxInertia(0.1, kCube);
      body.inverse_inertia_B = body.inertia_B.inverse();
    }
    ContactProblem::Joint& joint = problem.joints.emplace_back();
    joint.A = 0;
    joint.B = 1;
    joint.joint = world->scene.joints.data();
    joint.frames = framesOf(*joint.joint, {{0.1, 0, 0}, Quat::Identity()}, {});
    joint.lead.fill(1);
  }
  std::shared_ptr<const World> world;
  ContactProblem problem;
};

// The lead of the axis is what only joined_pair.h writes: another solver that left it as guessed would let the guesses
// grow from step to step.
TEST(JointEdge, SolversLeaveNoLeadAsItWasGuessed) {
  HingedPair of_newton, of_small_steps;
  NewtonSolver newton({}, 2, 0);
  newton.makeRoom(0, 0, 1);
  ASSERT_TRUE(newton.analyse(of_newton.problem, static_cast<std::size_t>(-1)));
  ASSERT_TRUE(newton.solve(of_newton.problem, kStep));
  SmallSteps({}, 2, 0).solve(of_small_steps.problem, kStep);
  for (const ContactProblem* problem : {&of_newton.problem, &of_small_steps.problem}) {
    for (const double lead : problem->joints[0].lead) EXPECT_NEAR(lead, 0, 1e-9);
  }
}

// A pair that Newton's method stepped while a finger touched it turns on evenly when the finger leaves.
TEST(JointEdge, PairTurnsOnEvenlyAfterAFingerLeavesIt) {
  WorldMaker maker;
  maker.gravity(Vec3::Zero()).box(kCube, 0.1, {}).box(kCube, 0.1, {{0.1, 0, 0}, Quat::Identity()});
  maker.joint(JointType::kHinge, {-0.05, 0, 0}, {Vec3::UnitY()}, 0).axes[0].friction = 1e-5;
  Runner runner(maker.world(), awake());
  runner.bodies.setVelocity(0, {0, 0, -0.1}, {0, 2, 0});
  runner.bodies.setVelocity(1, {0, 0, -0.1}, {0, -2, 0});
  runner.run(0.1);
  std::vector<ReferenceFinger> fingers{{0, {0, -0.025, 0}, {0, -1, 0}}};
  fingers[0].mu_static = fingers[0].mu_dynamic = 0;
  for (int n = 0; n < 20; ++n) {
    fingers[0].p_WH = runner[0].X_WB_end * fingers[0].p_BP + Vec3(0, 1e-6, 0);
    runner.step(exchangeOf(fingers, runner));
  }
  const double before = (runner[1].w_WB - runner[0].w_WB).y();
  const double angle = angleAbout(Vec3::UnitY(), runner[0].X_WB_end.q.conjugate() * runner[1].X_WB_end.q);
  runner.step();
  const double after = (runner[1].w_WB - runner[0].w_WB).y();
  const double turned = angleAbout(Vec3::UnitY(), runner[0].X_WB_end.q.conjugate() * runner[1].X_WB_end.q) - angle;
  EXPECT_NEAR(std::remainder(turned, 2 * std::numbers::pi) / kStep, (before + after) / 2, 0.1);
  EXPECT_NEAR(after, before, 0.05);
}

TEST(JointEdge, FirstSmallStepsAllocateNothing) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  HingedPair pair;
  SmallSteps steps({}, 2, 0);
  steps.makeRoom(0, 0, 1);
  const RealTimeGuard guard;
  steps.solve(pair.problem, kStep);
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

// A weight on a spring hangs at m g / K, to 1e-8 m: an impulse too many of h^2 K / 4 times the gain of a small step of
// h = 0.625 ms were h^2 g / 4 = 1e-6 m.
TEST(JointEdge, WeightHangsWhereItsSpringBalancesInSmallSteps) {
  OdeOptions options = awake();
  options.method.solver = DynamicsSettings::Solver::kSmallSteps;
  WorldMaker maker;
  maker.box(kCube, 0.5, {});
  JointAxis& axis = maker.joint(JointType::kSlider, Vec3::Zero(), {Vec3::UnitZ()}).axes[0];
  axis.stiffness = 200;
  axis.damping = 10;
  Runner runner(maker.world(), options);
  runner.run(6);
  EXPECT_NEAR(runner[0].X_WB_end.p.z(), -0.5 * kGravity / 200, 1e-8);
}

// In small steps, too, a door that falls on its stop stays there, alone or with a weight at its end: no rebound.
TEST(JointEdge, DoorFallsOnItsStopAndStaysInSmallSteps) {
  OdeOptions options = awake();
  options.method.solver = DynamicsSettings::Solver::kSmallSteps;
  for (const bool weighted : {false, true}) {
    WorldMaker maker;
    maker.box({0.02, 0.02, 0.3}, 0.3, {{0.15, 0, 0}, turn(-std::numbers::pi / 2, Vec3::UnitY())});
    maker.joint(JointType::kHinge, {0, 0, 0.15}, {Vec3::UnitY()}).axes[0].upper = radians(40);
    if (weighted) {
      maker.box(kCube, 0.1, {{0.3, 0, 0}, Quat::Identity()});
      maker.joint(JointType::kFixed, Vec3::Zero(), {}, 0);
    }
    Runner runner(maker.world(), options);
    const auto angle = [&] {
      const Vec3 out = runner[0].X_WB_end.q * -Vec3::UnitZ();
      return degrees(std::atan2(-out.z(), out.x()));
    };
    double beyond = 0, back = 0;
    bool reached = false;
    for (int n = 0; n < 200; ++n) {
      runner.step();
      reached = reached || angle() > 39.9;
      beyond = std::max(beyond, angle() - 40);
      if (reached) back = std::max(back, 40 - angle());
    }
    EXPECT_TRUE(reached);
    EXPECT_LT(beyond, 0.01);
    EXPECT_LT(back, 0.2);
    EXPECT_NEAR(angle(), 40, 1e-3);
  }
}

/// A knob about z with stops, turned by hand: held at these angles, then let go [degrees].
double knobAfter(std::optional<double> lower, std::optional<double> upper, const std::vector<double>& by_hand,
                 bool read) {
  WorldMaker maker;
  maker.gravity(Vec3::Zero()).box(kCube, 0.1, {});
  JointAxis& axis = maker.joint(JointType::kHinge, Vec3::Zero(), {Vec3::UnitZ()}).axes[0];
  if (lower) axis.lower = radians(*lower);
  if (upper) axis.upper = radians(*upper);
  Runner runner(maker.world(), awake());
  const auto at = [](double angle) { return Pose{Vec3::Zero(), turn(radians(angle), Vec3::UnitZ())}; };
  for (const double angle : by_hand) {
    runner.bodies.hold(0, at(angle), Vec3::Zero(), Vec3::Zero());
    if (read) runner.step();
  }
  runner.bodies.release(0, at(by_hand.back()), Vec3::Zero(), Vec3::Zero());
  runner.run(0.2);
  return degrees(angleAbout(Vec3::UnitZ(), runner[0].X_WB_end.q));
}

// What is held is turned elsewhere, seen at the ends of steps or not at all.
TEST(JointEdge, KnobThatWasTurnedByHandKnowsItsStops) {
  EXPECT_NEAR(knobAfter(-150, 150, {100, 150, -150}, false), -150, 1e-3);
  EXPECT_NEAR(knobAfter(-150, 150, {60, 120, 150, -140}, true), -140, 1e-3);
  EXPECT_NEAR(knobAfter({}, 150, {-100, -200}, true), 160, 1e-3);
}

// Torn apart until its axes are parallel, which no motion of a closed one reaches, a universal joint closes again.
TEST(JointEdge, UniversalWithParallelAxesClosesAgain) {
  WorldMaker maker;
  maker.gravity(Vec3::Zero()).box(kCube, 0.1, {});
  maker.joint(JointType::kUniversal, {0, 0, 0.05}, {Vec3::UnitX(), Vec3::UnitY()});
  Runner runner(maker.world(), awake());
  const Pose torn{{0, 0, 0}, turn(std::numbers::pi / 2, Vec3::UnitZ())};
  runner.bodies.hold(0, torn, Vec3::Zero(), Vec3::Zero());
  runner.bodies.release(0, torn, Vec3::Zero(), Vec3::Zero());
  runner.run(2);
  EXPECT_EQ(runner.state.faults, 0U);
  EXPECT_LT(std::abs((runner[0].X_WB_end.q * Vec3::UnitY()).x()), 1e-6);
}

// An hour hand goes on: at 1.45e-4 rad/s it moves less within half a second than what counts as rest.
TEST(JointEdge, SlowMotorNeverFallsAsleep) {
  const double speed = 2 * std::numbers::pi / 43200;
  WorldMaker maker;
  maker.box({0.1, 0.01, 0.01}, 0.02, {});
  JointAxis& axis = maker.joint(JointType::kHinge, {-0.05, 0, 0}, {Vec3::UnitY()}).axes[0];
  axis.max_force = 0.1;
  axis.speed = speed;
  Runner runner(maker.world());
  runner.run(20);
  EXPECT_FALSE(runner[0].asleep);
  EXPECT_NEAR(angleAbout(Vec3::UnitY(), runner[0].X_WB_end.q), 20 * speed, 1e-3 * 20 * speed);
}

// While a hand-like assembly holds one of a joined pair still, the other falls asleep alone. It wakes when the first is
// moved on, and follows; and when the first is let go.
TEST(JointEdge, PartnerOfABodyThatWasPutWakesWithIt) {
  for (const bool swapped : {false, true}) {
    WorldMaker maker;
    maker.table();
    const Vec3 put(0, 0, 0.075), rests(0.2, 0, 0.025);
    for (const Vec3& p : {swapped ? rests : put, swapped ? put : rests}) maker.box(kCube, 0.1, {p, Quat::Identity()});
    maker.joint(JointType::kBall, swapped ? Vec3(0.1, 0, 0) : Vec3(-0.1, 0, 0), {}, 1);
    const std::size_t held = swapped ? 2 : 1, other = swapped ? 1 : 2;
    Runner runner(maker.world());
    SnapConstraints constraints;
    constraints.bodies.push_back({.body = static_cast<std::int32_t>(held), .X_WB = {put, Quat::Identity()}});
    constraints.bodies[0].fixed = true;
    runner.bodies.setSnapConstraints(constraints);
    runner.run(5);
    ASSERT_TRUE(runner[other].asleep);
    constraints.bodies[0].X_WB.p.y() += 0.1;
    runner.bodies.setSnapConstraints(constraints);
    runner.step();
    EXPECT_FALSE(runner[other].asleep);
    runner.run(5);
    const auto gap = [&] {
      return (runner[held].X_WB_end * Vec3(swapped ? -0.1 : 0.1, 0, swapped ? 0.05 : -0.05) -
              runner[other].X_WB_end * Vec3(swapped ? 0.1 : -0.1, 0, 0))
          .norm();
    };
    if (!swapped) {
      EXPECT_LT(gap(), 1e-6);
    }
    runner.bodies.setSnapConstraints({});
    runner.step();
    EXPECT_FALSE(runner[other].asleep);
    EXPECT_FALSE(runner[held].asleep);
  }
}

// The engine turns a joint around whose `body` stands still: motor and stops keep their sense.
TEST(JointEdge, TheEnginesOwnSolversMoveTheSameEitherWayRound) {
  using Solver = DynamicsSettings::Solver;
  for (const JointType type : {JointType::kHinge, JointType::kSlider}) {
    for (const Solver solver : {Solver::kDirect, Solver::kIterative, Solver::kAuto}) {
      for (const bool around : {false, true}) {
        WorldMaker maker;
        maker.gravity(Vec3::Zero()).box({0.2, 0.03, 0.1}, 0.4, {});
        if (around) maker.fixedBox(kCube, {{9, 9, 9}, Quat::Identity()});
        Joint& joint =
            maker.joint(type, around ? Vec3(-9, -9, -9) : Vec3::Zero(), {Vec3::UnitZ()}, around ? 0 : Joint::kWorld);
        joint.axes[0].lower = 0;
        joint.axes[0].upper = 0.3;
        joint.axes[0].speed = 0.5;
        joint.axes[0].max_force = 2;
        OdeOptions options = awake();
        options.method.solver = solver;
        Runner runner(maker.world(), options);
        runner.run(2);
        const Pose X_WB = runner[0].X_WB_end;
        const double way = type == JointType::kHinge ? angleAbout(Vec3::UnitZ(), X_WB.q) : X_WB.p.z();
        EXPECT_NEAR(way, around ? -0.3 : 0.3, 1e-3) << nameOf(type) << " solver " << static_cast<int>(solver) << around;
      }
    }
  }
}

}  // namespace
}  // namespace presa::ode
