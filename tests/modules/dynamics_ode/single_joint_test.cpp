#include <Eigen/LU>
#include <functional>
#include <random>

#include "modules/dynamics_ode/contact_solver/axis_laws.h"
#include "modules/dynamics_ode/rotation.h"
#include "tests/modules/dynamics_ode/support.h"
#include "tests/support/alloc_lock_guard.h"

// Islands of one joint, which are stepped without Newton's method: doors, drawers, pairs.
namespace presa::ode {
namespace {

// A joint whose parts change roles: `body` stands still and `to` moves. Where the axis then is in `body`.
void turnAround(WorldMaker& maker, JointType type, const Vec3& p_W, const Vec3& along_W) {
  maker.fixedBox(kCube, {{9, 9, 9}, Quat::Identity()});
  maker.joint(type, p_W - Vec3(9, 9, 9), {along_W}, 0);
}

// Without a torque about its axis a door turns evenly, whatever its shape: to rounding of 2000 steps.
TEST(SingleJoint, DoorTurnsEvenlyAboutAnyAxis) {
  const Vec3 along = Vec3(1, -2, 2) / 3, p_WJ(0.1, 0.2, -0.3), p_BJ(-0.05, 0.02, 0.04);
  const Quat q = turn(0.8, Vec3(2, 1, 0).normalized());
  const Pose start{p_WJ - q * p_BJ, q};
  for (const bool around : {false, true}) {
    WorldMaker maker;
    maker.gravity(Vec3::Zero()).box({0.1, 0.2, 0.05}, 0.3, start);
    if (around) {
      turnAround(maker, JointType::kHinge, p_WJ, along);
    } else {
      maker.joint(JointType::kHinge, p_BJ, {q.conjugate() * along});
    }
    Runner runner(maker.world(), awake());
    const double speed = 7;
    runner.bodies.setVelocity(0, speed * along.cross(start.p - p_WJ), speed * along);
    double gap = 0, off = 0, faster = 0;
    for (int n = 1; n <= 2000; ++n) {
      runner.step();
      const Pose X_WB = runner[0].X_WB_end;
      const Quat expected = turn(speed * n * kStep, along) * q;
      gap = std::max(gap, (X_WB * p_BJ - p_WJ).norm());
      off = std::max(off, X_WB.q.angularDistance(expected));
      faster = std::max(faster, (runner[0].w_WB - speed * along).norm());
    }
    EXPECT_LT(gap, 1e-14);
    EXPECT_LT(off, 1e-12);
    EXPECT_LT(faster, 1e-12);
  }
}

// A joint that holds `to` by `body` holds as the same joint the other way round, with stops, spring, friction and motor.
TEST(SingleJoint, HoldsTheSameEitherWayRound) {
  for (const JointType type : {JointType::kHinge, JointType::kSlider}) {
    const Vec3 along = Vec3(0.2, 1, 0.1).normalized(), p_WJ(-0.1, 0, 0.05);
    const auto start = [&](bool around) {
      WorldMaker maker;
      maker.box({0.2, 0.03, 0.1}, 0.4, {});
      if (around) {
        turnAround(maker, type, p_WJ, -along);
      } else {
        maker.joint(type, p_WJ, {along});
      }
      World world = *maker.world();
      JointAxis& axis = world.scene.joints[0].axes[0];
      axis.lower = type == JointType::kHinge ? -1.2 : -0.02;
      axis.upper = 1.5;
      axis.stiffness = type == JointType::kHinge ? 0.1 : 20;
      axis.damping = 0.002;
      axis.friction = 0.003;
      return std::make_unique<Runner>(std::make_shared<World>(world), awake());
    };
    const auto one = start(false), other = start(true);
    double apart = 0;
    for (int n = 0; n < 400; ++n) {
      one->step();
      other->step();
      apart = std::max(apart, ((*one)[0].X_WB_end.p - (*other)[0].X_WB_end.p).norm());
    }
    EXPECT_LT(apart, 1e-10) << nameOf(type);
    EXPECT_GT(((*one)[0].X_WB_end.p).norm(), 0.01);
  }
}

// The velocity under springs, stops, friction and a motor at once, against bisection.
TEST(SingleJoint, SpeedIsWhereTheLawsBalance) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int n = 0; n < 2000; ++n) {
    JointAxis axis;
    if (any(random) > 0) axis.lower = -0.01;
    if (any(random) > 0) axis.upper = 0.01;
    if (any(random) > 0) axis.friction = 0.5 + 0.4 * any(random);
    if (any(random) > 0) axis.max_force = 1 + any(random);
    if (any(random) > 0) axis.stiffness = 100 + 90 * any(random);
    if (any(random) > 0) axis.damping = 1 + any(random);
    axis.speed = 2 * any(random);
    const double inertia = 0.1 + 0.09 * any(random), free = 5 * any(random);
    const AxisLaws laws = lawsOf(axis, 0.012 * any(random), any(random), 1e8 * inertia, kStep);
    double low = -100, high = 100;
    for (int i = 0; i < 200; ++i) {
      const double u = (low + high) / 2;
      double sum = 0;
      for (const AxisLaw& law : laws.all()) sum += law.clamped(law.springAt(u));
      (inertia * (u - free) < sum ? low : high) = u;
    }
    ASSERT_NEAR(speedUnder(laws, inertia, free), (low + high) / 2, 1e-12) << n;
  }
}

// Two bodies hinged at their centres of mass, in free flight. A spring: the trapezoidal rule with the reduced inertia
// I1 I2 / (I1 + I2), as of a slider (Joint.SpringOfASliderKeepsPeriodAndAmplitude).
struct Top {
  explicit Top(const std::function<void(JointAxis&)>& change) {
    const Vec3 size(0.1, 0.1, 0.02), other(0.06, 0.06, 0.05);
    const Quat q = turn(0.6, Vec3(1, 1, 1).normalized());
    along = q * Vec3::UnitZ();
    WorldMaker maker;
    maker.gravity(Vec3::Zero()).box(size, 0.5, {{0, 0, 0}, q}).box(other, 0.2, {{0, 0, 0}, q});
    change(maker.joint(JointType::kHinge, Vec3::Zero(), {Vec3::UnitZ()}, 0).axes[0]);
    runner = std::make_unique<Runner>(maker.world(), awake());
    first = boxInertia(0.5, size)(2, 2);
    second = boxInertia(0.2, other)(2, 2);
  }
  void spin(double a, double b) {
    runner->bodies.setVelocity(0, {0.1, 0, 0}, a * along);
    runner->bodies.setVelocity(1, {0.1, 0, 0}, b * along);
  }
  double relativeSpeed() const { return ((*runner)[1].w_WB - (*runner)[0].w_WB).dot(along); }
  double reduced() const { return first * second / (first + second); }
  Vec3 along;
  std::unique_ptr<Runner> runner;
  double first = 0, second = 0;
};

TEST(SingleJoint, SpringOfAPairSwingsWithTheReducedInertia) {
  const double stiffness = 0.02;
  Top top([&](JointAxis& axis) { axis.stiffness = stiffness; });
  top.spin(3, 4);
  const double omega = std::sqrt(stiffness / top.reduced()), step = 2 * std::atan(kStep * omega / 2);
  const double c = kStep / std::sin(step);  // x_n = c sin(n step), x_1 = h v_0 with v_0 = 1
  double worst = 0;
  for (int n = 1; n <= 1000; ++n) {
    top.runner->step();
    const double x = turnBetween((*top.runner)[0].X_WB_end.q, (*top.runner)[1].X_WB_end.q).dot(top.along);
    worst = std::max(worst, std::abs(x - c * std::sin(n * step)));
  }
  EXPECT_LT(worst, 1e-6 * c);
  EXPECT_LT(c, 1);  // less than half a turn
}

// Friction takes the relative speed at its torque over the reduced inertia, then holds; the sum of momenta stays.
TEST(SingleJoint, FrictionStopsAPairAgainstEachOther) {
  Top top([](JointAxis& axis) { axis.friction = 1e-4; });
  top.spin(0, 1);
  top.runner->run(0.5);
  EXPECT_NEAR(top.relativeSpeed(), 1 - 0.5 * 1e-4 / top.reduced(), 1e-6);
  top.runner->run(2);
  EXPECT_NEAR(top.relativeSpeed(), 0, 1e-6);
  EXPECT_NEAR((*top.runner)[0].w_WB.dot(top.along), top.second / (top.first + top.second), 1e-6);
}

// Friction that never slips makes one body of two, hinged off their centres, however they tumble: what the locked directions
// do to the axis counts.
TEST(SingleJoint, HeldByFrictionAPairTumblesAsOne) {
  WorldMaker maker;
  maker.gravity(Vec3::Zero())
      .box({0.1, 0.04, 0.02}, 0.3, {})
      .box({0.05, 0.1, 0.03}, 0.2, {{0.06, 0.05, 0}, Quat::Identity()});
  maker.joint(JointType::kHinge, {-0.03, -0.04, 0.01}, {{0, 1, 1}}, 0).axes[0].friction = 10;
  Runner runner(maker.world(), awake());
  const Vec3 spin(3, -4, 2);
  runner.bodies.setVelocity(0, Vec3::Zero(), spin);
  runner.bodies.setVelocity(1, spin.cross(Vec3(0.06, 0.05, 0)), spin);
  double slid = 0;
  for (int n = 0; n < 400; ++n) {
    runner.step();
    slid = std::max(slid, turnBetween(runner[0].X_WB_end.q, runner[1].X_WB_end.q).norm());
  }
  EXPECT_LT(slid, 1e-6);  // of 11 rad; what is left are the last corrections, 1e-7 rad/s each
}

// The order of the Magnus series: halving the step shrinks the error to a sixteenth, against Runge-Kutta in a thousand
// steps; momentum to rounding.
TEST(SingleJoint, MagnusRotationIsOfFourthOrder) {
  const Mat3 inertia = Vec3(1e-5, 2e-5, 2.5e-5).asDiagonal(), inverse = inertia.inverse();
  const Quat start = turn(0.4, Vec3(1, 2, 2) / 3);
  const Vec3 spin(3, 8, -2);
  const auto after = [&](auto rotate, int steps) {
    Quat q = start;
    Vec3 w = spin;
    for (int i = 0; i < steps; ++i) rotate(q, w, inertia, inverse, 0.04 / steps);
    return std::pair(q, w);
  };
  const auto angularMomentum = [&](const Quat& q, const Vec3& w) { return Vec3(q * (inertia * (q.conjugate() * w))); };
  const auto [exact, w_exact] = after(driftRotation, 1000);
  const auto [coarse, w_coarse] = after(magnusRotation, 8);
  const auto [fine, w_fine] = after(magnusRotation, 16);
  const double error = turnBetween(exact, coarse).norm(), finer = turnBetween(exact, fine).norm();
  EXPECT_LT(error, 1e-8);
  EXPECT_NEAR(error / finer, 16, 2);
  const Vec3 L = angularMomentum(start, spin);
  EXPECT_LT((angularMomentum(coarse, w_coarse) - L).norm(), 1e-13 * L.norm());
}

// A top with two equal moments precesses about its momentum at L / I1: R = exp(L t / I1) exp(spin in the body).
TEST(SingleJoint, MagnusRotationFollowsASymmetricTop) {
  const double across = 2e-5, axial = 0.5e-5, time = 1;
  const Mat3 inertia = Vec3(across, across, axial).asDiagonal(), inverse = inertia.inverse();
  const Vec3 spin(2, 0, 6);
  Quat q = Quat::Identity();
  Vec3 w = spin;
  for (int i = 0; i < 200; ++i) magnusRotation(q, w, inertia, inverse, time / 200);
  const Vec3 L = inertia * spin;
  const Quat expected =
      turn(L.norm() / across * time, L.normalized()) * turn((1 - axial / across) * spin.z() * time, Vec3::UnitZ());
  EXPECT_LT(turnBetween(expected, q).norm(), 1e-7);
}

// Side by side, whether they can share their sub-steps and the kind of inertia or not.
TEST(SingleJoint, MagnusRotationOfTwoBodiesIsThatOfEach) {
  const Mat3 R = turn(0.7, Vec3(2, -1, 2) / 3).toRotationMatrix();
  const Mat3 straight = Vec3(1e-5, 2e-5, 2.5e-5).asDiagonal(), oblique = R * straight * R.transpose();
  for (const auto& [inertia_A, inertia_B] : {std::pair(straight, straight), std::pair(oblique, oblique),
                                             std::pair(straight, oblique), std::pair(oblique, straight)}) {
    const Mat3 inverse_A = inertia_A.inverse(), inverse_B = inertia_B.inverse();
    for (const double spin : {0.0, 3.0, 40.0}) {
      Quat q_A = turn(0.4, Vec3(1, 2, 2) / 3), q_B = turn(-1.3, Vec3(2, 2, -1) / 3);
      Vec3 w_A(3, 8, -2), w_B = spin * Vec3(0.3, -0.9, 0.4);
      Quat alone_A = q_A, alone_B = q_B;
      Vec3 spin_A = w_A, spin_B = w_B;
      magnusRotation(alone_A, spin_A, inertia_A, inverse_A, 0.005);
      magnusRotation(alone_B, spin_B, inertia_B, inverse_B, 0.005);
      magnusRotations({q_A, w_A, inertia_A, inverse_A}, {q_B, w_B, inertia_B, inverse_B}, 0.005);
      EXPECT_EQ(q_A.coeffs(), alone_A.coeffs());
      EXPECT_EQ(q_B.coeffs(), alone_B.coeffs());
      EXPECT_EQ(w_A, spin_A);
      EXPECT_EQ(w_B, spin_B);
    }
  }
}

TEST(SingleJoint, StepAllocatesNothing) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  WorldMaker maker;
  maker.box(kCube, 0.1, {}).box(kCube, 0.1, {{0.1, 0, 0}, Quat::Identity()});
  maker.joint(JointType::kBall, {-0.05, 0, 0}, {}, 0);
  double x = 1;
  for (const JointType type : {JointType::kHinge, JointType::kSlider, JointType::kBall, JointType::kFixed}) {
    const bool axis = type == JointType::kHinge || type == JointType::kSlider;
    maker.box(kCube, 0.1, {{x += 1, 0, 0}, Quat::Identity()});
    Joint& joint = maker.joint(type, {0.05, 0, 0}, axis ? std::vector<Vec3>{Vec3::UnitY()} : std::vector<Vec3>{});
    if (axis) joint.axes[0].upper = 0.1;
  }
  Runner runner(maker.world(), awake());
  runner.bodies.makeRoom(ContactExchange());
  runner.step();
  for (int n = 0; n < 100; ++n) {
    const RealTimeGuard guard;
    runner.bodies.step({}, runner.time, kStep);
    ASSERT_EQ(guard.violations(), 0) << guard.first();
  }
}

}  // namespace
}  // namespace presa::ode
