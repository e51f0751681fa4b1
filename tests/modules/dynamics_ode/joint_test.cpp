#include "tests/modules/dynamics_ode/pendulum.h"
#include "tests/modules/dynamics_ode/support.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/effort.h"

namespace presa::ode {
namespace {

// A rod that hangs from the world by a hinge about y at its upper end.
struct Pendulum {
  static constexpr double kLength = 0.3, kMass = 0.3;
  explicit Pendulum(double angle, JointType type = JointType::kHinge, double step = kStep) : h(step) {
    const Vec3 size(0.02, 0.02, kLength), p_BJ(0, 0, kLength / 2);
    const Quat q = turn(angle, Vec3::UnitY());
    WorldMaker maker;
    maker.box(size, kMass, {q * Vec3(0, 0, -kLength / 2), q});
    maker.joint(type, p_BJ, type == JointType::kBall ? std::vector<Vec3>{} : std::vector<Vec3>{Vec3::UnitY()});
    runner = std::make_unique<Runner>(maker.world(), awake());
    inertia = boxInertia(kMass, size);
    about_joint = inertia(1, 1) + kMass * kLength * kLength / 4;
  }
  double angle() const {
    const Vec3 down = (*runner)[0].X_WB_end.q * -Vec3::UnitZ();
    return std::atan2(-down.x(), -down.z());
  }
  double potential() const { return kMass * kGravity * (*runner)[0].X_WB_end.p.z(); }
  std::unique_ptr<Runner> runner;
  Mat3 inertia;
  double about_joint = 0, h;
};

// Period against the elliptic integral. Energy at the turning points, where velocities do not matter: their heights. An
// integrator of second order is off by (h omega)^2 / 24 = 5e-5 in the period; the energy of a symplectic one does not
// drift.
TEST(Joint, PendulumKeepsPeriodAndEnergyForAMinute) {
  for (const double degree : {5.0, 60.0, 120.0}) {
    const double start = radians(degree);
    Pendulum pendulum(start);
    Runner& runner = *pendulum.runner;
    const double arm = Pendulum::kMass * kGravity * Pendulum::kLength / 2;
    const double period = 4 * std::sqrt(pendulum.about_joint / arm) * ellipticK(std::sin(start / 2));
    const Swing swung = swingOver(unlessSanitized(12000, 1500), kStep, [&] {
      runner.step();
      return std::pair(pendulum.angle(), pendulum.potential());
    });
    const double swing = arm * (1 - std::cos(start));
    EXPECT_NEAR(swung.period / period, 1, 2e-4) << degree << " degrees";
    EXPECT_LT(swung.spread / swing, 1e-4) << degree << " degrees";
  }
}

TEST(Joint, HingeHoldsAHundredNewtonsForAMinute) {
  WorldMaker maker;
  maker.box({0.3, 0.2, 0.02}, 1, {{0.15, 0, 0}, Quat::Identity()});
  maker.joint(JointType::kHinge, {-0.15, 0, 0}, {Vec3::UnitY()});
  World world = *maker.world();
  world.scene.bodies[0].force_W = {0, 100, 0};  // along the axis, with a moment of 15 N m across it
  Runner runner(std::make_shared<World>(world), awake());
  runner.bodies.setVelocity(0, Vec3::Zero(), Vec3::Zero());
  double gap = 0, tilt = 0;
  for (int i = 0; i < unlessSanitized(12000, 1500); ++i) {
    runner.step();
    const Pose X_WB = runner[0].X_WB_end;
    gap = std::max(gap, (X_WB * Vec3(-0.15, 0, 0)).norm());
    tilt = std::max(tilt, degrees(std::acos(std::min(1.0, (X_WB.q * Vec3::UnitY()).y()))));
  }
  EXPECT_LT(gap, 1e-5);
  EXPECT_LT(tilt, 0.01);
}

// A mass on a spring along a slider: the period of the trapezoidal rule, 2 pi sqrt(m/K) (1 + (h omega)^2 / 12); it keeps
// its amplitude, also where the spring is so stiff that a step is longer than the period.
TEST(Joint, SpringOfASliderKeepsPeriodAndAmplitude) {
  for (const double stiffness : {50.0, 2000.0, 5e5}) {
    WorldMaker maker;
    maker.gravity(Vec3::Zero()).box(kCube, 0.5, {});
    JointAxis& axis = maker.joint(JointType::kSlider, Vec3::Zero(), {{1, 2, 2}}).axes[0];
    axis.stiffness = stiffness;
    Runner runner(maker.world(), awake());
    const Vec3 along = Vec3(1, 2, 2).normalized();
    runner.bodies.setVelocity(0, 0.1 * along, Vec3::Zero());
    const double omega = std::sqrt(stiffness / 0.5), turn = 2 * std::atan(kStep * omega / 2);  // a step, in phase
    double worst = 0, aside = 0;
    // x_n = c sin(n turn) with x_1 = h v_1, v_1 = v_0
    const double c = kStep * 0.1 / std::sin(turn);
    for (int n = 1; n <= 2000; ++n) {
      runner.step();
      const Vec3 p = runner[0].X_WB_end.p;
      worst = std::max(worst, std::abs(p.dot(along) - c * std::sin(n * turn)));
      aside = std::max(aside, (p - p.dot(along) * along).norm());
    }
    EXPECT_LT(worst, 1e-6 * c);
    EXPECT_LT(aside, 1e-9);
  }
}

// Free fall along a slope, against friction: a = g (sin - friction / m g); at rest below the bound.
TEST(Joint, FrictionOfASliderIsCoulombs) {
  for (const double friction : {1.0, 3.0}) {
    WorldMaker maker;
    const Vec3 along = Vec3(std::cos(0.5), 0, -std::sin(0.5));
    maker.box(kCube, 0.4, {});
    maker.joint(JointType::kSlider, Vec3::Zero(), {along}).axes[0].friction = friction;
    Runner runner(maker.world(), awake());
    runner.run(1);
    const double a = std::max(0.0, kGravity * std::sin(0.5) - friction / 0.4);
    EXPECT_NEAR(runner[0].v_WB.dot(along), a, 1e-6);
    if (a == 0) {
      EXPECT_LT(runner[0].X_WB_end.p.norm(), 1e-8);
    }
  }
}

TEST(Joint, MotorReachesItsSpeedWithItsTorqueAndNoMore) {
  const Vec3 size(0.1, 0.1, 0.02);
  WorldMaker maker;
  maker.gravity(Vec3::Zero()).box(size, 0.5, {});
  JointAxis& axis = maker.joint(JointType::kHinge, Vec3::Zero(), {Vec3::UnitZ()}).axes[0];
  axis.speed = 30;
  axis.max_force = 0.01;
  Runner runner(maker.world(), awake());
  const double inertia = boxInertia(0.5, size)(2, 2);
  runner.run(1);
  EXPECT_NEAR(runner[0].w_WB.z(), 0.01 / inertia, 1e-6);
  runner.run(4);
  EXPECT_NEAR(runner[0].w_WB.z(), 30, 1e-6);
}

TEST(Joint, StopsHoldTheDoorAndTheDrawer) {
  WorldMaker maker;
  maker.box({0.02, 0.02, 0.3}, 0.3, {{0.15, 0, 0}, turn(-std::numbers::pi / 2, Vec3::UnitY())});
  JointAxis& hinge = maker.joint(JointType::kHinge, {0, 0, 0.15}, {Vec3::UnitY()}).axes[0];
  hinge.upper = radians(40);
  maker.box(kCube, 0.2, {{0, 1, 0}, Quat::Identity()});
  JointAxis& slider = maker.joint(JointType::kSlider, Vec3::Zero(), {Vec3::UnitZ()}).axes[0];
  slider.lower = -0.03;
  Runner runner(maker.world(), awake());
  double beyond = 0;
  for (int i = 0; i < 400; ++i) {
    runner.step();
    const Vec3 out = runner[0].X_WB_end.q * -Vec3::UnitZ();
    beyond = std::max({beyond, std::atan2(-out.z(), out.x()) - radians(40), -0.03 - runner[1].X_WB_end.p.z()});
  }
  EXPECT_LT(beyond, 1e-7);
  const Vec3 out = runner[0].X_WB_end.q * -Vec3::UnitZ();
  EXPECT_NEAR(degrees(std::atan2(-out.z(), out.x())), 40, 1e-4);
  EXPECT_NEAR(runner[1].X_WB_end.p.z(), -0.03, 1e-8);
}

// Hooke's joint at a bend of 40 degrees: tan(out) = tan(in) cos(bend), of shafts turning in bearings.
TEST(Joint, UniversalTurnsAsHookesJoint) {
  const double bend = radians(40);
  WorldMaker maker;
  maker.gravity(Vec3::Zero()).box({0.02, 0.02, 0.1}, 0.1, {{0, 0, -0.05}, Quat::Identity()});
  JointAxis& motor = maker.joint(JointType::kHinge, {0, 0, 0}, {Vec3::UnitZ()}).axes[0];
  motor.speed = 2;
  motor.max_force = 100;
  // the fork of the first shaft holds the cross along x, that of the second along the y of its own
  const Quat q = turn(bend, Vec3::UnitX());
  maker.box({0.02, 0.02, 0.1}, 0.1, {q * Vec3(0, 0, 0.05), q});
  maker.joint(JointType::kUniversal, {0, 0, -0.05}, {Vec3::UnitX(), Vec3::UnitY()}, 0);
  maker.joint(JointType::kHinge, {0, 0, 0.05}, {Vec3::UnitZ()});
  Runner runner(maker.world(), awake());
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    runner.step();
    const Vec3 in = runner[0].X_WB_end.q * Vec3::UnitX(), out = q.conjugate() * (runner[1].X_WB_end.q * Vec3::UnitX());
    const double a = std::atan2(in.y(), in.x()), b = std::atan2(out.y(), out.x());
    const double expected = std::atan2(std::sin(a) * std::cos(bend), std::cos(a));
    worst = std::max(worst, std::abs(std::remainder(b - expected, 2 * std::numbers::pi)));
  }
  EXPECT_LT(worst, 1e-5);
}

// Two bodies in a fall without gravity keep momentum and angular momentum to rounding, whatever joins them.
TEST(Joint, FreePairKeepsItsMomenta) {
  for (const JointType type : {JointType::kFixed, JointType::kHinge, JointType::kSlider, JointType::kBall,
                               JointType::kUniversal, JointType::kPrismaticRotary}) {
    std::vector<Vec3> axes;
    if (type == JointType::kHinge || type == JointType::kSlider) axes = {{1, 0, 1}};
    if (type == JointType::kUniversal || type == JointType::kPrismaticRotary) axes = {{1, 0, 1}, {0, 1, 0}};
    const Vec3 size(0.05, 0.08, 0.11), other(0.06, 0.03, 0.2);
    WorldMaker maker;
    maker.gravity(Vec3::Zero()).box(size, 0.2, {}).box(other, 0.5, {{0.1, 0.05, 0}, turn(0.7, {1, 1, 0})});
    maker.joint(type, {-0.02, 0.05, 0.1}, axes, 0);
    Runner runner(maker.world(), awake());
    runner.bodies.setVelocity(0, {0.3, 0.2, -0.1}, {3, -2, 5});
    runner.bodies.setVelocity(1, {-0.1, 0.1, 0.2}, {-1, 4, 2});
    const std::array<Mat3, 2> inertias{boxInertia(0.2, size), boxInertia(0.5, other)};
    const std::array<double, 2> masses{0.2, 0.5};
    const auto momenta = [&] {
      std::pair<Vec3, Vec3> sum{Vec3::Zero(), Vec3::Zero()};
      for (std::size_t i = 0; i < 2; ++i) {
        const BodyMotion& at = runner[i];
        sum.first += masses[i] * at.v_WB;
        sum.second += masses[i] * at.X_WB_end.p.cross(at.v_WB) +
                      at.X_WB_end.q * (inertias[i] * (at.X_WB_end.q.conjugate() * at.w_WB));
      }
      return sum;
    };
    for (int i = 0; i < 3; ++i) runner.step();  // the velocities at the start contradict the joint
    const auto [p, L] = momenta();
    runner.run(10);
    const auto [p_end, L_end] = momenta();
    EXPECT_LT((p_end - p).norm(), 1e-9);
    EXPECT_LT((L_end - L).norm(), 1e-9) << nameOf(type);
  }
}

// A chain of ten links with a weight a thousand times as heavy at its end. A push sets it swinging: its links then turn at
// h omega = 5, beyond what a step can follow, and the weight as a pendulum; neither gains energy.
struct Chain {
  static constexpr double kLink = 0.04, kLight = 0.001, kHeavy = 1, kEnd = 10 * kLink + 0.025;
  Chain() {
    WorldMaker maker;
    for (int i = 0; i < 10; ++i) {
      maker.box({0.01, 0.01, kLink}, kLight, {{0, 0, -(i + 0.5) * kLink}, Quat::Identity()});
      maker.joint(JointType::kBall, {0, 0, kLink / 2}, {}, i == 0 ? Joint::kWorld : static_cast<std::size_t>(i - 1));
    }
    maker.box(Vec3::Constant(0.05), kHeavy, {{0, 0, -kEnd}, Quat::Identity()});
    maker.joint(JointType::kBall, {0, 0, 0.025}, {}, 9);
    runner = std::make_unique<Runner>(maker.world(), awake());
  }
  Vec3 end() const { return (*runner)[10].X_WB_end.p; }
  std::unique_ptr<Runner> runner;
};

TEST(Joint, ChainWithAHeavyEndHangsStill) {
  Chain chain;
  double moved = 0;
  for (int i = 0; i < unlessSanitized(2000, 200); ++i) {
    chain.runner->step();
    moved = std::max(moved, (chain.end() - Vec3(0, 0, -Chain::kEnd)).norm());
  }
  EXPECT_LT(moved, 1e-6);
}

TEST(Joint, ChainWithAHeavyEndSwingsWithoutGainingEnergy) {
  Chain chain;
  const double speed = 0.3, highest = speed * speed / (2 * kGravity);  // of the weight, as a point
  chain.runner->bodies.setVelocity(10, {speed, 0, 0}, Vec3::Zero());
  chain.runner->bodies.setVelocity(4, {0, 0.2, 0}, {3, 0, 0});  // shakes a link: 2e-5 J, 0.002 mm of the weight
  double rise = 0, stretch = 0;
  for (int i = 0; i < unlessSanitized(12000, 1000); ++i) {
    chain.runner->step();
    rise = std::max(rise, chain.end().z() + Chain::kEnd);
    stretch = std::max(stretch, chain.end().norm() - Chain::kEnd);
  }
  EXPECT_LT(rise, highest);
  EXPECT_GT(rise, 0.9 * highest);  // what the links shake is damped
  EXPECT_LT(stretch, 1e-7);
}

// A balance: a beam on a hinge above its centre of mass, two weights on balls at its ends. At rest the moments agree.
TEST(Joint, BalanceTiltsByTheDifferenceOfItsWeights) {
  const double above = 0.004, arm = 0.12, beam = 0.08;
  for (const double extra : {0.0, 0.001, 0.004}) {
    WorldMaker maker;
    maker.box({2 * arm, 0.01, 0.01}, beam, {{0, 0, -above}, Quat::Identity()});
    maker.joint(JointType::kHinge, {0, 0, above}, {Vec3::UnitY()}).axes[0].damping = 0.02;
    for (const double side : {-1.0, 1.0}) {
      const double mass = 0.1 + (side > 0 ? extra : 0);
      maker.box(Vec3::Constant(0.03), mass, {{side * arm, 0, -above - 0.05}, Quat::Identity()});
      maker.joint(JointType::kBall, {0, 0, 0.05}, {Vec3::UnitY()}, 0).axes[0].damping = 1e-3;
    }
    Runner runner(maker.world(), awake());
    runner.run(30);
    const Vec3 along = runner[0].X_WB_end.q * Vec3::UnitX();
    const double tilt = std::atan(extra * arm / ((beam + 0.2 + extra) * above));  // the ends are as far below the hinge
    EXPECT_NEAR(std::atan2(-along.z(), along.x()), tilt, 1e-6);
  }
}

// A four-bar linkage with a motor: the follower's angle is that of the closed triangle and quadrilateral.
TEST(Joint, FourBarLinkageStaysClosed) {
  const double crank = 0.03, coupler = 0.08, follower = 0.06, ground = 0.09;
  const auto bar = [](const Vec3& from, const Vec3& to) {
    const Vec3 along = to - from;
    return Pose{(from + to) / 2, turn(std::atan2(along.y(), along.x()), Vec3::UnitZ())};
  };
  // at the start the crank points along y
  const Vec3 O(0, 0, 0), P(ground, 0, 0), A(0, crank, 0);
  const auto follow = [&](const Vec3& from) {
    const Vec3 to_P = P - from;
    const double d = to_P.norm(), a = (coupler * coupler - follower * follower + d * d) / (2 * d);
    const Vec3 foot = from + a / d * to_P;
    return Vec3(foot + std::sqrt(coupler * coupler - a * a) / d * Vec3(-to_P.y(), to_P.x(), 0));
  };
  const Vec3 B = follow(A);
  WorldMaker maker;
  maker.box({crank, 0.004, 0.004}, 0.02, bar(O, A));
  JointAxis& motor = maker.joint(JointType::kHinge, {-crank / 2, 0, 0}, {Vec3::UnitZ()}).axes[0];
  motor.speed = 5;
  motor.max_force = 10;
  maker.box({coupler, 0.004, 0.004}, 0.03, bar(A, B));
  maker.joint(JointType::kHinge, {-coupler / 2, 0, 0}, {Vec3::UnitZ()}, 0);
  maker.box({follower, 0.004, 0.004}, 0.03, bar(B, P));
  maker.joint(JointType::kHinge, {-follower / 2, 0, 0}, {Vec3::UnitZ()}, 1);
  maker.joint(JointType::kHinge, {follower / 2, 0, 0}, {Vec3::UnitZ()});
  Runner runner(maker.world(), awake());
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    runner.step();
    const Vec3 tip = runner[0].X_WB_end * Vec3(crank / 2, 0, 0), end = runner[2].X_WB_end * Vec3(-follower / 2, 0, 0);
    worst = std::max(worst, (end - follow(tip)).norm());
  }
  EXPECT_LT(worst, 1e-7);
}

// A double pendulum against the same with steps of 50 us, of second order: its error at 5 ms is 1e4 times as large.
TEST(Joint, DoublePendulumConvergesWithTheSquareOfTheStep) {
  const auto swing = [](double h) {
    WorldMaker maker;
    for (int i = 0; i < 2; ++i) {
      maker.box({0.3, 0.02, 0.02}, 0.2, {{0.15 + 0.3 * i, 0, 0}, Quat::Identity()});
      maker.joint(JointType::kHinge, {-0.15, 0, 0}, {Vec3::UnitY()}, i == 0 ? Joint::kWorld : 0);
    }
    Runner runner(maker.world(), awake());
    // velocities belong to half steps: the first is half a step
    const long steps = std::lround(0.6 / h);
    runner.bodies.setVelocity(0, Vec3::Zero(), Vec3::Zero());
    for (long i = 0; i < steps; ++i) runner.step({}, h);
    // the pose half a step ago, which is where one from rest would be
    const Vec3 p = runner[1].X_WB_end.p - h / 2 * runner[1].v_WB;
    return p;
  };
  const Vec3 reference = swing(5e-5);
  const double coarse = (swing(5e-3) - reference).norm(), fine = (swing(2.5e-3) - reference).norm();
  EXPECT_LT(coarse, 2e-4);
  EXPECT_NEAR(coarse / fine, 4, 0.5);
}

// Springs, stops, motors and joints of every kind in one island, with a finger.
TEST(Joint, StepAllocatesNothing) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  WorldMaker maker;
  maker.table().box(kCube, 0.1, {{0, 0, 0.025}, Quat::Identity()});
  std::size_t last = 1;
  double x = 0;
  for (const JointType type : {JointType::kFixed, JointType::kHinge, JointType::kSlider, JointType::kBall,
                               JointType::kUniversal, JointType::kPrismaticRotary}) {
    std::vector<Vec3> axes;
    if (type == JointType::kHinge || type == JointType::kSlider || type == JointType::kBall) axes = {Vec3::UnitZ()};
    if (type == JointType::kUniversal || type == JointType::kPrismaticRotary) axes = {Vec3::UnitZ(), Vec3::UnitX()};
    x += 0.06;
    maker.box(kCube, 0.01, {{x, 0, 0.025}, Quat::Identity()});
    for (JointAxis& axis : maker.joint(type, {-0.03, 0, 0}, axes, last).axes) {
      axis.friction = 0.01;
      axis.damping = 0.01;
      if (type == JointType::kBall) continue;
      axis.lower = -0.1;
      axis.upper = 0.1;
      axis.stiffness = 1;
      axis.max_force = 0.1;
    }
    ++last;
  }
  Runner runner(maker.world(), awake());
  runner.bodies.makeRoom(ContactExchange(2));
  std::vector<ReferenceFinger> fingers = pinch(1, 0.05, 0.002, 2000, 0.8);
  for (ReferenceFinger& finger : fingers) finger.p_WH.z() += 0.025;
  for (int n = 0; n < 10; ++n) runner.step(exchangeOf(fingers, runner));
  for (int n = 0; n < 200; ++n) {
    for (ReferenceFinger& finger : fingers) finger.p_WH.z() += 1e-4;
    const ContactExchange exchange = exchangeOf(fingers, runner);
    const RealTimeGuard guard;
    runner.step(exchange);
    ASSERT_EQ(guard.violations(), 0) << guard.first() << " at " << runner.time;
  }
  EXPECT_GT(runner[1].X_WB_end.p.z(), 0.03);
}

// Joined bodies sleep and wake together.
TEST(Joint, BodiesSleepAndWakeTogether) {
  WorldMaker maker;
  maker.table().box(kCube, 0.1, {{0, 0, 0.025}, Quat::Identity()}).box(kCube, 0.1, {{0.2, 0, 0.025}, Quat::Identity()});
  maker.joint(JointType::kBall, {-0.1, 0, 0}, {}, 1);
  Runner runner(maker.world());
  runner.run(3);
  ASSERT_TRUE(runner[1].asleep && runner[2].asleep);
  runner.bodies.setVelocity(1, {0, 0, 0.5}, Vec3::Zero());
  runner.step();
  EXPECT_FALSE(runner[2].asleep);
}

// In small steps joints are springs of sweeps: looser, but bounded.
TEST(Joint, SmallStepsHoldADoor) {
  OdeOptions options = awake();
  options.method.solver = DynamicsSettings::Solver::kSmallSteps;
  WorldMaker maker;
  maker.box({0.3, 0.02, 0.4}, 0.5, {{0.15, 0, 0}, Quat::Identity()});
  maker.joint(JointType::kHinge, {-0.15, 0, 0}, {Vec3::UnitZ()});
  Runner runner(maker.world(), options);
  runner.bodies.setVelocity(0, {0, 0.3, 0}, {0, 0, 2});
  double gap = 0;
  for (int i = 0; i < 1000; ++i) {
    runner.step();
    gap = std::max(gap, (runner[0].X_WB_end * Vec3(-0.15, 0, 0)).norm());
  }
  EXPECT_LT(gap, 1e-4);
  EXPECT_NEAR(runner[0].w_WB.z(), 2, 0.02);
}

}  // namespace
}  // namespace presa::ode
