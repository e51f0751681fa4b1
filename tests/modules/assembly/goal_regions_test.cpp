#include "modules/assembly/goal_regions.h"

#include <gtest/gtest.h>

#include <numbers>

namespace presa::assembly {
namespace {

using Status = GoalState::Status;

constexpr double kPeriod = 0.01;
constexpr double kPi = std::numbers::pi;

Quat aboutZ(double angle) { return Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ())); }

// Oracle: all symmetric orientations, tested one by one.
TEST(GoalPose, TakesTheNearestOfItsTurns) {
  for (const std::size_t fold : {1U, 2U, 4U, 20U}) {
    for (double angle = -3; angle < 3; angle += 0.0717) {
      const Quat q = Quat(Eigen::AngleAxisd(0.1, Vec3(1, 0.3, 0).normalized())) * aboutZ(angle);
      const Pose goal{{1, 2, 3}, Quat(Eigen::AngleAxisd(0.05, Vec3::UnitY()))};
      double min = 10;
      for (std::size_t k = 0; k < fold; ++k)
        min = std::min(
            min, (goal.q * aboutZ(2 * kPi * static_cast<double>(k) / static_cast<double>(fold))).angularDistance(q));
      EXPECT_NEAR(nearestTurn(goal, fold, q).q.angularDistance(q), min, 1e-7) << fold << " " << angle;
    }
  }
}

TEST(GoalPose, RoundThingsLeaveOnlyTheTilt) {
  const Quat tilt(Eigen::AngleAxisd(0.2, Vec3::UnitX()));
  EXPECT_NEAR(nearestTurn({}, 0, tilt * aboutZ(1.234)).q.angularDistance(tilt * aboutZ(1.234)), 0.2, 1e-9);
}

/// Two goals, one above the other, for the same two bodies; a third body has no goal. All are asleep, so that none is
/// slowed.
class GoalRegionsTest : public testing::Test {
 protected:
  GoalRegionsTest() {
    assembly.goals = {{"lower", {0, 1}, {}, 1, {}}, {"upper", {0, 1}, {{0, 0, 0.1}, Quat::Identity()}, 1, {0}}};
    objects.bodies.resize(3);
    for (std::size_t i = 0; i < 3; ++i) {
      objects.bodies[i].X_WB_end.p = {1 + static_cast<double>(i), 0, 0};
      objects.bodies[i].asleep = true;
    }
  }
  void at(std::size_t body, const Vec3& p, double angle = 0) { objects.bodies[body].X_WB_end = {p, aboutZ(angle)}; }
  void step(int steps = 1) {
    if (!regions) regions.emplace(assembly, 3);
    for (int i = 0; i < steps; ++i) regions->step(objects, kPeriod);
  }
  Status status(std::size_t goal) const { return regions->state().goals[goal].status; }
  static constexpr int kArrives = static_cast<int>(GoalPulls::kSettle / kPeriod) + 1;

  Assembly assembly;
  ObjectState objects;
  std::optional<GoalRegions> regions;
};

TEST_F(GoalRegionsTest, NothingNearNothingDrawn) {
  step();
  EXPECT_EQ(regions->snapConstraints().bodies.size(), 0);
  EXPECT_EQ(status(0), Status::kOpen);
}

TEST_F(GoalRegionsTest, DrawsWhatIsInReachOfDistanceAndAngle) {
  at(0, {0.019, 0, 0}, 29 * kPi / 180);
  step();
  ASSERT_EQ(regions->snapConstraints().bodies.size(), 1);
  EXPECT_EQ(regions->snapConstraints().bodies[0].body, 0);
  EXPECT_FALSE(regions->snapConstraints().bodies[0].fixed);
  EXPECT_NEAR(regions->snapConstraints().bodies[0].max_acceleration, 1.5 * 9.81 * kPeriod / GoalPulls::kRise, 1e-12)
      << "rises softly";
  step(40);
  EXPECT_EQ(regions->snapConstraints().bodies[0].max_acceleration, 1.5 * 9.81);
  at(0, {0.019, 0, 0}, 45 * kPi / 180);
  step();
  EXPECT_EQ(regions->snapConstraints().bodies.size(), 0) << "turned away";
}

TEST_F(GoalRegionsTest, LetsGoALittleFartherThanItTakes) {
  at(0, {0.024, 0, 0});
  step();
  EXPECT_EQ(status(0), Status::kOpen);
  at(0, {0.019, 0, 0});
  step();
  at(0, {0.024, 0, 0});
  step();
  EXPECT_EQ(status(0), Status::kDrawing);
  at(0, {0.026, 0, 0});
  step();
  EXPECT_EQ(status(0), Status::kOpen);
}

TEST_F(GoalRegionsTest, OfTwoAlikeTheNearerIsTaken) {
  at(0, {0.015, 0, 0});
  at(1, {0, 0.010, 0});
  step();
  EXPECT_EQ(regions->state().goals[0].body, 1);
  EXPECT_EQ(regions->snapConstraints().bodies.size(), 1);
}

TEST_F(GoalRegionsTest, WhatMustWaitSaysForWhat) {
  at(0, {0.005, 0, 0.1});
  step();
  EXPECT_EQ(status(1), Status::kBlocked);
  EXPECT_EQ(regions->state().goals[1].missing, 0);
  EXPECT_EQ(regions->snapConstraints().bodies.size(), 0) << "not drawn";
  at(1, Vec3::Zero());
  step(kArrives + 1);
  EXPECT_EQ(status(0), Status::kFilled);
  EXPECT_EQ(status(1), Status::kDrawing) << "now it may";
}

TEST_F(GoalRegionsTest, ArrivedIsWhatStaysThereSlowly) {
  at(0, {0.0004, 0, 0});
  objects.bodies[0].v_WB = {0.02, 0, 0};
  step(3 * kArrives);
  EXPECT_EQ(status(0), Status::kDrawing) << "passing through";
  objects.bodies[0].v_WB.setZero();
  step(kArrives - 2);
  EXPECT_EQ(status(0), Status::kDrawing);
  step(3);
  ASSERT_EQ(status(0), Status::kFilled);
  EXPECT_TRUE(regions->snapConstraints().bodies[0].fixed);
  EXPECT_EQ(regions->state().filled, 1);
  EXPECT_EQ(regions->state().last_filled, 0);
  at(1, {0.001, 0, 0});
  step(kArrives);
  EXPECT_EQ(regions->state().goals[0].body, 0) << "a filled place takes nothing else";
}

TEST_F(GoalRegionsTest, UndoTakesOutTheLastAndLeavesItAloneUntilItWasAway) {
  at(0, Vec3::Zero());
  step(kArrives);
  at(1, {0, 0, 0.1});
  step(kArrives);
  ASSERT_EQ(regions->state().filled, 2);
  regions->undo();
  step(kArrives);
  EXPECT_EQ(status(1), Status::kOpen);
  EXPECT_EQ(regions->state().filled, 1);
  EXPECT_EQ(regions->state().last_filled, 0);
  at(1, {0.1, 0, 0.1});
  step();
  at(1, {0, 0, 0.1});
  step(kArrives);
  EXPECT_EQ(status(1), Status::kFilled) << "it was away";
  regions->undo();
  regions->undo();
  regions->undo();
  step();
  EXPECT_EQ(regions->state().filled, 0);
}

TEST_F(GoalRegionsTest, WhatLeavesTheFieldIsBroughtBackWellInside) {
  assembly.workspace = Assembly::Workspace{{0, 0, 0}, {1, 1, 1}};
  at(0, {0.4, 0, 0});
  at(1, {0.2, 0.2, 0});
  step();
  EXPECT_EQ(regions->snapConstraints().bodies.size(), 0);
  at(0, {0.7, 0.1, 0});
  at(2, {5, 0, 0});
  step();
  ASSERT_EQ(regions->snapConstraints().bodies.size(), 1) << "what belongs nowhere may go where it likes";
  const SnapConstraint& back = regions->snapConstraints().bodies[0];
  EXPECT_EQ(back.body, 0);
  EXPECT_FALSE(back.turns);
  EXPECT_LT((back.X_WB.p - Vec3(0.4, 0.1, 0)).norm(), 1e-12);
  at(0, {0.48, 0.1, 0});
  step();
  EXPECT_EQ(regions->snapConstraints().bodies.size(), 1) << "not yet";
  at(0, {0.45, 0.1, 0});
  step();
  EXPECT_EQ(regions->snapConstraints().bodies.size(), 0);
  EXPECT_EQ(regions->state().brought_back, 0);
}

// Pulled against the side of the ground over whose edge it fell, a body would be held there by friction.
TEST_F(GoalRegionsTest, WhatDoesNotComeBackIsLiftedFirst) {
  assembly.workspace = Assembly::Workspace{{0, 0, 0}, {1, 1, 1}};
  const auto drawn_to = [&](const Vec3& p_W) {
    const SnapConstraint& back = regions->snapConstraints().bodies[0];
    return regions->snapConstraints().bodies.size() == 1 && (back.X_WB.p - p_W).norm() < 1e-12;
  };
  at(0, {0.7, 0.1, -0.49});
  at(1, {0.2, 0.2, 0});
  step();
  EXPECT_TRUE(drawn_to({0.4, 0.1, -0.4}));
  step(static_cast<int>(std::lround(2 / kPeriod)));
  EXPECT_TRUE(drawn_to({0.7, 0.1, -0.4})) << "straight up";
  at(0, {0.7, 0.1, -0.405});
  step();
  EXPECT_TRUE(drawn_to({0.4, 0.1, -0.4}));
}

TEST_F(GoalRegionsTest, WhatRollsIsSlowedAndNothingElse) {
  at(0, {0.3, 0, 0});
  for (std::size_t i = 0; i < 3; ++i) objects.bodies[i].asleep = false;
  objects.bodies[1].v_WB = {2, 0, 0};
  objects.bodies[2].v_WB = {0.05, 0, 0};
  step();
  ASSERT_EQ(regions->snapConstraints().bodies.size(), 1) << "awake: at rest now, it would roll on otherwise";
  objects.bodies[0].v_WB = {0.05, 0, 0};
  step();
  ASSERT_EQ(regions->snapConstraints().bodies.size(), 1);
  EXPECT_EQ(regions->snapConstraints().bodies[0].body, 0);
  EXPECT_EQ(regions->snapConstraints().bodies[0].speed, 0);
  EXPECT_EQ(regions->snapConstraints().bodies[0].max_acceleration, GoalPulls::kGrass);
}

}  // namespace
}  // namespace presa::assembly
