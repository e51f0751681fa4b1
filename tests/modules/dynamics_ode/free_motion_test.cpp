#include "modules/dynamics_ode/rotation.h"
#include "tests/modules/dynamics_ode/support.h"

namespace presa::ode {
namespace {

Vec3 angularMomentum(const Mat3& inertia, const BodyMotion& motion) {
  const Quat& q = motion.X_WB_end.q;
  return q * (inertia * (q.conjugate() * motion.w_WB));
}

// Semi-implicit Euler has a closed form: v_n = v_0 + n h g, x_n = x_0 + h sum v_i. Tolerance: rounding of 400
// additions.
TEST(FreeMotion, FallIsTheClosedFormOfSemiImplicitEuler) {
  Runner runner(WorldMaker().box({0.05, 0.06, 0.07}, 0.2, {{0.1, 0.2, 1}, turn(0.3, {1, 2, 3})}).world());
  for (int n = 1; n <= 400; ++n) {
    runner.step();
    EXPECT_NEAR(runner[0].X_WB_end.p.z(), 1 - kStep * kStep * kGravity * n * (n + 1) / 2, 1e-12);
    EXPECT_NEAR(runner[0].v_WB.z(), -n * kStep * kGravity, 1e-12);
  }
  EXPECT_EQ(runner[0].X_WB_end.p.x(), 0.1);
  EXPECT_NEAR(runner[0].X_WB_end.q.angularDistance(turn(0.3, {1, 2, 3})), 0, 1e-12);
}

// Readers interpolate between the two poses of a state, so each state must start where the one before ended.
TEST(FreeMotion, EachStateBeginsWhereTheLastEnded) {
  Runner runner(WorldMaker().box({0.05, 0.06, 0.07}, 0.2, {}).table().world());
  for (int n = 0; n < 10; ++n) {
    const ObjectState before = runner.state;
    runner.step();
    EXPECT_EQ(runner.state.count(), 2);
    EXPECT_EQ(runner.state.time_begin, before.time_end);
    EXPECT_EQ(runner.state.time_end, before.time_end + kStep);
    EXPECT_EQ(runner[0].X_WB_begin.p, before.bodies[0].X_WB_end.p);
    EXPECT_EQ(runner[0].X_WB_begin.q.coeffs(), before.bodies[0].X_WB_end.q.coeffs());
    EXPECT_EQ(runner[1].X_WB_end.p, Vec3(0, 0, -0.05));
  }
}

// Dzhanibekov's spin about the middle axis: 9 flips in 20 s in a reference integration with steps of 10 us; ODE's own
// gyroscopic term gives 61. Tolerances: one order above the measured error of one Runge-Kutta step of 5 ms.
TEST(FreeMotion, TumblingKeepsEnergyAndMomentumAndFlipsNineTimes) {
  const Mat3 inertia = Vec3(1e-5, 2e-5, 2.5e-5).asDiagonal();
  WorldMaker maker;
  maker.gravity(Vec3::Zero()).add(Sphere{0.01}, {}, {0.1, Vec3::Zero(), inertia});
  Runner runner(maker.world());
  runner.bodies.setVelocity(0, Vec3::Zero(), {0.01, 20, 0.01});
  const double energy = 0.5 * Vec3(0.01, 20, 0.01).dot(inertia * Vec3(0.01, 20, 0.01));
  const Vec3 momentum = inertia * Vec3(0.01, 20, 0.01);
  int flips = 0;
  double side = 1, worst_energy = 0, worst_momentum = 0;
  for (int n = 0; n < 4000; ++n) {
    runner.step();
    const Vec3 w_B = runner[0].X_WB_end.q.conjugate() * runner[0].w_WB;
    if (w_B.y() * side < 0) {
      ++flips;
      side = -side;
    }
    worst_energy = std::max(worst_energy, std::abs(0.5 * w_B.dot(inertia * w_B) / energy - 1));
    worst_momentum =
        std::max(worst_momentum, (angularMomentum(inertia, runner[0]) - momentum).norm() / momentum.norm());
  }
  EXPECT_EQ(flips, 9);
  EXPECT_LT(worst_energy, 1e-6);
  EXPECT_LT(worst_momentum, 1e-11);  // rounding of 4000 steps
}

// A body whose centre of mass is not its origin rotates about the centre of mass, which moves uniformly; the origin
// circles around it, and the reported velocity is the origin's.
TEST(FreeMotion, OffCentreBodyTurnsAboutItsCentreOfMass) {
  const Vec3 p_BCm(0.02, -0.01, 0.005);
  const Pose start{{0.3, 0.2, 0.5}, turn(0.7, {1, 1, 0})};
  WorldMaker maker;
  maker.gravity(Vec3::Zero()).add(Box{{0.05, 0.06, 0.07}}, start, {0.2, p_BCm, boxInertia(0.2, {0.05, 0.06, 0.07})});
  Runner runner(maker.world());
  const Vec3 w_WB(1, 2, 3), v_WCm(0.1, 0, -0.2);
  runner.bodies.setVelocity(0, v_WCm - w_WB.cross(start.q * p_BCm), w_WB);
  for (int n = 1; n <= 400; ++n) {
    runner.step();
    const BodyMotion& motion = runner[0];
    const Vec3 expected = start * p_BCm + n * kStep * v_WCm;
    EXPECT_LT((motion.X_WB_end * p_BCm - expected).norm(), 1e-12);
    EXPECT_LT((motion.v_WB + motion.w_WB.cross(motion.X_WB_end.q * p_BCm) - v_WCm).norm(), 1e-12);
  }
}

// A fast spin of a body with equal moments is a rotation by exactly w t; ODE's own update rotates by 2 atan(w h / 2)
// per step, 2 % less at 100 rad/s. Tolerance: error of the Runge-Kutta step, (w h)^5/3840 per step.
TEST(FreeMotion, FastSpinTurnsByItsAngle) {
  WorldMaker maker;
  maker.gravity(Vec3::Zero()).add(Sphere{0.02}, {}, {0.1, Vec3::Zero(), 1e-5 * Mat3::Identity()});
  Runner runner(maker.world());
  runner.bodies.setVelocity(0, Vec3::Zero(), {0, 0, 100});
  for (int n = 1; n <= 200; ++n) {
    runner.step();
    EXPECT_LT(runner[0].X_WB_end.q.angularDistance(turn(100 * n * kStep, Vec3::UnitZ())), 2e-6 * n + 1e-7);
  }
}

// Two free boxes that collide off centre keep total linear and angular momentum. Tolerance: rounding for the linear
// part; the angular part is exact at the positions at the start of a step, and the first-order drift of the lever arms
// remains.
TEST(FreeMotion, CollisionKeepsMomentum) {
  const Vec3 size(0.05, 0.05, 0.05);
  WorldMaker maker;
  maker.gravity(Vec3::Zero()).box(size, 0.2, {}).box(size, 0.5, {{0.08, 0.01, 0.02}, turn(0.4, {1, 2, 3})});
  Runner runner(maker.world());
  runner.bodies.setVelocity(0, {0.5, 0, 0}, {0, 0, 1});
  const auto linear = [&] { return Vec3(0.2 * runner[0].v_WB + 0.5 * runner[1].v_WB); };
  const auto angular = [&] {
    Vec3 total = Vec3::Zero();
    const double mass[] = {0.2, 0.5};
    for (std::size_t i = 0; i < 2; ++i) {
      total +=
          mass[i] * runner[i].X_WB_end.p.cross(runner[i].v_WB) + angularMomentum(boxInertia(mass[i], size), runner[i]);
    }
    return total;
  };
  runner.bodies.write(0, runner.state);
  const Vec3 linear_before = linear(), angular_before = angular();
  bool touched = false;
  for (int n = 0; n < 100; ++n) {
    runner.step();
    touched = touched || !runner.bodies.contacts().empty();
    EXPECT_LT((linear() - linear_before).norm(), 1e-14);
    EXPECT_LT((angular() - angular_before).norm(), 1e-12);
  }
  EXPECT_TRUE(touched);
  EXPECT_GT(runner[1].v_WB.norm(), 0.05);
}

// The explicit step, which Presa keeps for comparison, is of first order: its error in a step falls with its square.
// Reference: the fourth-order step.
TEST(EulerRotation, IsOfFirstOrder) {
  const Mat3 inertia = Vec3(1, 2, 3.5).asDiagonal();
  const auto error = [&](double h) {
    Quat q = turn(0.7, {1, 2, 3}), exact_q = q;
    Vec3 w(3, -2, 5), exact = w;
    eulerRotation(q, w, inertia, inertia.inverse(), h);
    driftRotation(exact_q, exact, inertia, inertia.inverse(), h);
    return (w - exact).norm() + q.angularDistance(exact_q);
  };
  EXPECT_NEAR(error(1e-3) / error(5e-4), 4, 0.2);
}

}  // namespace
}  // namespace presa::ode
