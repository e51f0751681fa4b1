#include "tests/modules/dynamics_ode/support.h"

// When the dynamics are late, what fingers hold is stepped and the rest stands still.
namespace presa::ode {
namespace {

/// A cube at the origin between two fingers, and another one that falls beside it.
std::shared_ptr<const World> heldAndLoose(double aside = 0.5) {
  return WorldMaker()
      .box(kCube, 0.1, {Vec3::Zero(), Quat::Identity()})
      .box(kCube, 0.1, {{aside, 0, 0}, Quat::Identity()})
      .world();
}

TEST(LateStep, ALooseBodyStandsStillAndGoesOnAsBefore) {
  Runner late(heldAndLoose()), in_time(heldAndLoose());
  std::vector<ReferenceFinger> fingers = pinch(0, kEdge, 0.002, 1000, 1);
  for (int i = 0; i < 40; ++i) {
    const ContactExchange exchange = exchangeOf(fingers, late);
    const bool is_late = i % 4 == 3;
    const Vec3 loose = late[1].X_WB_end.p, held = late[0].X_WB_end.p;
    late.step(exchange, kStep, is_late);
    EXPECT_EQ(late[1].X_WB_end.p == loose, is_late);
    EXPECT_NE(late[0].X_WB_end.p, held);
    EXPECT_FALSE(late[1].asleep);
    if (!is_late) in_time.step();
    EXPECT_EQ(late[1].X_WB_end.p, in_time[1].X_WB_end.p);
    EXPECT_EQ(late[1].X_WB_end.q.coeffs(), in_time[1].X_WB_end.q.coeffs());
  }
  EXPECT_NEAR(late.state.far_lag, 10 * kStep, 1e-12);
}

// A whole step that makes many late is not taken again at once.
TEST(LateStep, AHeapThatTakesTooLongWaits) {
  Runner runner(heldAndLoose());
  std::vector<ReferenceFinger> fingers = pinch(0, kEdge, 0.002, 1000, 1);
  const auto moves = [&](bool late) {
    const Vec3 before = runner[1].X_WB_end.p;
    runner.step(exchangeOf(fingers, runner), kStep, late);
    return runner[1].X_WB_end.p != before;
  };
  const auto waits = [&] {
    int steps = 0;
    while (!moves(false)) ++steps;
    return steps;
  };
  EXPECT_TRUE(moves(false));
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(moves(true));
  EXPECT_EQ(waits(), 20);
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(moves(true));
  EXPECT_EQ(waits(), 40);
  EXPECT_FALSE(moves(true));  // not for long this time
  EXPECT_EQ(waits(), 0);
  EXPECT_EQ(waits(), 0);
}

// A body that the haptic thread moves counts as held: what is loose waits for it, though no finger touches a body that
// the dynamics move.
TEST(LateStep, AHeapWaitsForWhatTheHapticThreadMoves) {
  Runner runner(heldAndLoose());
  const auto moves = [&](bool late) {
    const Vec3 before = runner[1].X_WB_end.p;
    runner.bodies.hold(0, {Vec3(0, 0, 0.1 * runner.time), Quat::Identity()}, Vec3(0, 0, 0.1), Vec3::Zero());
    runner.step({}, kStep, late);
    return runner[1].X_WB_end.p != before;
  };
  EXPECT_TRUE(moves(false));
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(moves(true));
  int waited = 0;
  while (!moves(false)) ++waited;
  EXPECT_EQ(waited, 20);
  EXPECT_NEAR(runner[0].v_WB.z(), 0.1, 1e-12);
}

// Where nothing is held no step waits: the world runs slower, and its state is never old.
TEST(LateStep, WithNothingHeldOnlyLateStepsAreLeftOut) {
  Runner runner(heldAndLoose());
  for (int i = 0; i < 60; ++i) runner.step({}, kStep, i % 6 != 0);
  EXPECT_NEAR(runner.state.far_lag, 50 * kStep, 1e-12);
  runner.step();
  EXPECT_NEAR(runner[1].v_WB.z(), -kGravity * 11 * kStep, 1e-9);
}

// A held body that arrives at one that stands still takes it along in the same step.
TEST(LateStep, AHeldBodyWakesWhatItMeets) {
  Runner runner(WorldMaker()
                    .gravity(Vec3::Zero())
                    .box(kCube, 0.1, {Vec3::Zero(), Quat::Identity()})
                    .box(kCube, 0.1, {{kEdge + 0.001, 0, 0}, Quat::Identity()})
                    .world());
  std::vector<ReferenceFinger> fingers{{0, {-kEdge / 2, 0, 0}, -Vec3::UnitX()}};
  fingers[0].p_WH = fingers[0].p_BP + 0.003 * Vec3::UnitX();
  for (int i = 0; i < 20; ++i) {
    fingers[0].v_WH = 0.1 * Vec3::UnitX();
    fingers[0].p_WH += kStep * fingers[0].v_WH;
    runner.step(exchangeOf(fingers, runner), kStep, true);
    EXPECT_LT(runner[0].X_WB_end.p.x(), runner[1].X_WB_end.p.x() - kEdge + 1e-5);
  }
  runner.step();  // in time: what flew ahead of the finger goes on
  EXPECT_GT(runner[1].v_WB.x(), 0.05);
}

// A pile that stood still keeps the forces of its contacts: it goes on resting.
TEST(LateStep, ATowerRestsOn) {
  WorldMaker maker;
  maker.table();
  for (int i = 0; i < 10; ++i) maker.box(kCube, 0.1, {{0.5, 0, kEdge / 2 + i * kEdge}, Quat::Identity()});
  maker.box(kCube, 0.1, {{0, 0, 0.5}, Quat::Identity()});
  Runner runner(maker.world(), awake());
  std::vector<ReferenceFinger> fingers = pinch(11, kEdge, 0.002, 1000, 1);
  for (ReferenceFinger& finger : fingers) finger.p_WH += Vec3(0, 0, 0.5);
  runner.run(0.5);
  const Vec3 top = runner[10].X_WB_end.p;
  OdeOptions options;
  Runner sleeping(maker.world(), options);
  for (int i = 0; i < 60; ++i) sleeping.step(exchangeOf(fingers, sleeping), kStep, i % 2 == 0);
  EXPECT_GT(sleeping.state.far_lag, 0);
  EXPECT_LT((sleeping[10].X_WB_end.p - top).norm(), 1e-5);
}

}  // namespace
}  // namespace presa::ode
