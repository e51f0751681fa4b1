// Snap constraints of an assembly: the law against its closed solution, and its limits.
#include <gtest/gtest.h>

#include "modules/dynamics_ode/snap_drive.h"
#include "tests/modules/dynamics_ode/support.h"

namespace presa::ode {
namespace {

constexpr double kRate = 20;  // [1/s]

SnapConstraints towards(const Pose& X_WB, double speed, double max_acceleration, std::int32_t body = 0) {
  SnapConstraints snap_constraints;
  snap_constraints.bodies.push_back(
      {.body = body, .X_WB = X_WB, .rate = kRate, .speed = speed, .max_acceleration = max_acceleration});
  return snap_constraints;
}

SnapConstraints putAt(const Pose& X_WB, std::int32_t body = 0) {
  SnapConstraints snap_constraints = towards(X_WB, 0, 0, body);
  snap_constraints.bodies[0].fixed = true;
  return snap_constraints;
}

Pose turned(double angle, const Vec3& axis, const Vec3& p = Vec3::Zero()) {
  return {p, Quat(Eigen::AngleAxisd(angle, axis.normalized()))};
}

class SnappedBody : public testing::Test {
 protected:
  /// Alone in empty space, unless a test adds more.
  WorldMaker maker = [] {
    WorldMaker one;
    one.gravity(Vec3::Zero()).box({0.06, 0.04, 0.02}, 0.1, {});
    return one;
  }();
  ObjectState state;
  void run(OdeWorld& bodies, double h, double from, double to) {
    for (double t = from; t < to - h / 2; t += h) bodies.step({}, t, h, state);
  }
};

// Each step covers a fraction rate h of the remaining way: x_n = x_0 (1 - rate h)^n, which is exp(-rate t) for small
// steps.
TEST_F(SnappedBody, TheWayThatIsLeftDecays) {
  const Vec3 goal(0.02, -0.01, 0.015);
  OdeWorld bodies(maker.world(), awake());
  bodies.setSnapConstraints(towards({goal, Quat::Identity()}, 10, 1e6));
  for (int n = 1; n <= 100; ++n) {
    bodies.step({}, (n - 1) * kStep, kStep, state);
    EXPECT_LT((state.bodies[0].X_WB_end.p - goal * (1 - std::pow(1 - kRate * kStep, n))).norm(), 1e-6 * goal.norm());
  }
}

// The same for rotation about any axis; the rotation over a step is an arc, not a chord, hence 1 %.
TEST_F(SnappedBody, AndTheTurn) {
  const double angle = 0.4;
  const Quat goal = turned(angle, {1, 2, -1}).q;
  OdeWorld bodies(maker.world(), awake());
  bodies.setSnapConstraints(towards({Vec3::Zero(), goal}, 10, 1e6));
  for (int n = 1; n <= 40; ++n) {
    bodies.step({}, (n - 1) * kStep, kStep, state);
    EXPECT_NEAR(state.bodies[0].X_WB_end.q.angularDistance(goal), angle * std::pow(1 - kRate * kStep, n), 0.01 * angle);
  }
}

// From far away: acceleration at most `max`, speed at most `speed`.
TEST_F(SnappedBody, IsNeverDrawnHarderOrFasterThanAsked) {
  OdeWorld bodies(maker.world(), awake());
  bodies.setSnapConstraints(towards({{1, 0, 0}, Quat::Identity()}, 0.1, 3));
  for (int n = 1; n <= 20; ++n) {
    bodies.step({}, (n - 1) * kStep, kStep, state);
    EXPECT_NEAR(state.bodies[0].v_WB.x(), std::min(0.1, 3 * n * kStep), 1e-6);
  }
}

TEST_F(SnappedBody, IsNeverBrakedHarderThanAsked) {
  OdeWorld bodies(maker.world(), awake());
  bodies.setVelocity(0, {0, 2, 0}, Vec3::Zero());
  bodies.setSnapConstraints(towards({}, 0.1, 20));
  bodies.step({}, 0, kStep, state);
  EXPECT_NEAR(state.bodies[0].v_WB.y(), 2 - 20 * kStep, 1e-6);
}

// A pull stronger than friction arrives exactly; a weaker one does not move the body at all.
TEST_F(SnappedBody, FrictionStopsOnlyAPullThatIsWeaker) {
  maker.gravity({0, 0, -kGravity}).fixedBox({1, 1, 0.1}, {{0, 0, -0.06}, Quat::Identity()});
  for (const double weights : {0.4, 0.6}) {
    OdeWorld bodies(maker.world());
    run(bodies, kStep, 0, 2);
    ASSERT_TRUE(state.bodies[0].asleep);
    bodies.setSnapConstraints(
        towards({{0.01, 0, state.bodies[0].X_WB_end.p.z()}, Quat::Identity()}, 0.1, weights * kGravity));
    run(bodies, kStep, 2, 4);
    EXPECT_NEAR(state.bodies[0].X_WB_end.p.x(), weights < 0.5 ? 0 : 0.01, 2e-5) << weights << " of 0.5";
  }
}

TEST_F(SnappedBody, APutBodyIsCarriedSlowlyAndStandsExactly) {
  const Pose goal = turned(0.01, Vec3::UnitZ(), {0.0005, 0, 0});
  OdeWorld bodies(maker.world());
  bodies.setSnapConstraints(putAt(goal));
  bodies.step({}, 0, kStep, state);
  EXPECT_NEAR(state.bodies[0].X_WB_end.p.x(), SnapDrive::kCarrySpeed * kStep, 1e-12);
  run(bodies, kStep, kStep, 0.1);
  EXPECT_LT((state.bodies[0].X_WB_end.p - goal.p).norm(), 1e-15);
  EXPECT_LT(state.bodies[0].X_WB_end.q.angularDistance(goal.q), 1e-7);
}

// A fixed body supports another like a scene's fixed body; when released it falls from rest.
TEST_F(SnappedBody, APutBodyCarriesOthersAndFallsWhenItIsTaken) {
  maker.gravity({0, 0, -kGravity}).box({0.04, 0.04, 0.02}, 0.1, {{0, 0, 0.0201}, Quat::Identity()});
  OdeWorld bodies(maker.world());
  bodies.setSnapConstraints(putAt({}));
  run(bodies, kStep, 0, 2);
  EXPECT_EQ(state.bodies[0].X_WB_end.p.z(), 0);
  EXPECT_NEAR(state.bodies[1].X_WB_end.p.z(), 0.02, 1e-5) << "stands on it";
  EXPECT_TRUE(state.bodies[1].asleep);
  bodies.setSnapConstraints({});
  run(bodies, kStep, 2, 2.2);
  const int n = 40;  // semi-implicit Euler: sum of the speeds at the step ends
  EXPECT_NEAR(state.bodies[0].X_WB_end.p.z(), -kGravity * kStep * kStep * n * (n + 1) / 2, 1e-6)
      << "1e-6: the other lets go of it";
  EXPECT_LT(state.bodies[1].X_WB_end.p.z(), -0.1) << "woken, and without support";
}

// Pulled against a wall, a body sleeps like any other resting body, until its target changes.
TEST_F(SnappedBody, WhatIsHeldUpSleepsUntilThereIsNews) {
  maker.fixedBox({0.02, 1, 1}, {{0.0401, 0, 0}, Quat::Identity()});
  OdeWorld bodies(maker.world());
  bodies.setSnapConstraints(towards({{0.1, 0, 0}, Quat::Identity()}, 0.1, 3));
  run(bodies, kStep, 0, 2);
  ASSERT_TRUE(state.bodies[0].asleep);
  bodies.setSnapConstraints(towards({{0.1, 0, 0}, Quat::Identity()}, 0.1, 3));
  run(bodies, kStep, 2, 2.1);
  EXPECT_TRUE(state.bodies[0].asleep) << "nothing new";
  bodies.setSnapConstraints(towards({{-0.1, 0, 0}, Quat::Identity()}, 0.1, 3));
  run(bodies, kStep, 2.1, 2.2);
  EXPECT_LT(state.bodies[0].X_WB_end.p.x(), -0.005);
}

// A carried body pushes sleeping bodies out of its way. Passing through them, it would be released inside and thrown
// away.
TEST_F(SnappedBody, WhatIsCarriedPushesWhatSleepsInItsWay) {
  maker.gravity({0, 0, -kGravity}).fixedBox({1, 1, 0.1}, {{0, 0, -0.06}, Quat::Identity()});
  maker.box({0.06, 0.04, 0.02}, 0.1, {{0.1, 0, 0}, Quat::Identity()});
  OdeWorld bodies(maker.world());
  run(bodies, kStep, 0, 2);
  ASSERT_TRUE(state.bodies[2].asleep);
  SnapConstraints carried = putAt({{0.1, 0, 0}, Quat::Identity()});
  carried.bodies[0].speed = 0.1;
  bodies.setSnapConstraints(carried);
  run(bodies, kStep, 2, 3.5);
  EXPECT_NEAR(state.bodies[0].X_WB_end.p.x(), 0.1, 1e-12);
  EXPECT_NEAR(state.bodies[2].X_WB_end.p.x(), 0.16, 2e-3);
  bodies.setSnapConstraints({});
  run(bodies, kStep, 3.5, 3.6);
  EXPECT_LT(state.bodies[0].v_WB.norm() + state.bodies[2].v_WB.norm(), 0.05);
}

// Fixing and releasing a body must not wake a distant heap: that costs a second of solving.
TEST_F(SnappedBody, WhatIsPutAndTakenWakesOnlyItsNeighbours) {
  maker.gravity({0, 0, -kGravity}).fixedBox({1, 1, 0.1}, {{0, 0, -0.06}, Quat::Identity()});
  const double beside = 0.0605, far = 0.065;  // from centre to centre: gaps of 0.5 and 5 mm
  for (const double x : {beside, -far}) maker.box({0.06, 0.04, 0.02}, 0.1, {{x, 0, 0}, Quat::Identity()});
  OdeWorld bodies(maker.world());
  run(bodies, kStep, 0, 2);
  for (const std::size_t i : {0U, 2U, 3U}) ASSERT_TRUE(state.bodies[i].asleep) << i;
  bodies.setSnapConstraints(putAt(state.bodies[0].X_WB_end));
  bodies.step({}, 2, kStep, state);
  EXPECT_FALSE(state.bodies[2].asleep);
  EXPECT_TRUE(state.bodies[3].asleep);
}

}  // namespace
}  // namespace presa::ode
