#include "framework/core/math/random.h"
#include "tests/modules/dynamics_ode/support.h"

namespace presa::ode {
namespace {

WorldMaker sleepers(int n) {
  WorldMaker maker;
  maker.table();
  for (int i = 0; i < n * n * n; ++i) {
    maker.box(kCube, 0.1,
              {{0.051 * (i % n), 0.051 * (i / n % n), 0.025 + (0.05 - 1e-6) * (i / (n * n))}, Quat::Identity()});
  }
  return maker;
}

int asleep(const Runner& runner) {
  int count = 0;
  for (const BodyMotion& body : runner.state.bodies) count += body.asleep ? 1 : 0;
  return count;
}

TEST(Sleep, PileFallsAsleepAndStaysWhereItIs) {
  Runner runner(sleepers(3).world());
  runner.run(5);
  ASSERT_EQ(asleep(runner), 27);
  const ObjectState before = runner.state;
  runner.run(1);
  for (std::size_t i = 1; i <= 27; ++i) {
    EXPECT_EQ(runner[i].X_WB_end.p, before.bodies[i].X_WB_end.p);
    EXPECT_EQ(runner[i].X_WB_begin.p, before.bodies[i].X_WB_end.p);
    EXPECT_EQ(runner[i].v_WB, Vec3(Vec3::Zero()));
  }
  EXPECT_TRUE(runner.bodies.contacts().empty());
}

// Plates and bars poured onto each other: where edges rest on edges contacts come and go, and everything creeps by some
// 0.1 mm/s.
TEST(Sleep, AJumbleFallsAsleepThoughItCreeps) {
  RandomStream random(1, "jumble");
  WorldMaker maker;
  maker.table();
  constexpr int kBodies = 24;
  for (int i = 0; i < kBodies; ++i) {
    const Quat turn = Quat(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
    const Pose X_WB{{random.uniform(-0.06, 0.06), random.uniform(-0.06, 0.06), 0.05 + 0.05 * i}, turn};
    if (i % 3 == 0) maker.box({0.1, 0.05, 0.01}, 0.1, X_WB);
    if (i % 3 == 1) maker.box({0.06, 0.03, 0.03}, 0.1, X_WB);
    if (i % 3 == 2) maker.box({0.07, 0.05, 0.02}, 0.1, X_WB);
  }
  Runner runner(maker.world());
  double slept = 0;
  for (; asleep(runner) < kBodies && slept < 12; slept += 0.5) runner.run(0.5);
  EXPECT_LT(slept, 12);
}

TEST(Sleep, NothingSleepsWhereTheSceneForbidsIt) {
  OdeOptions options;
  options.method.sleeping = false;
  Runner runner(sleepers(1).world(), options);
  runner.run(5);
  EXPECT_EQ(asleep(runner), 0);
}

// A finger wakes the whole island that it touches and pushes it in the same step; other islands stay asleep.
TEST(Sleep, FingerWakesTheIslandInOneStep) {
  Runner runner(sleepers(2).box(kCube, 0.1, {{0.5, 0.5, 0.025}, Quat::Identity()}).world());
  runner.run(5);
  ASSERT_EQ(asleep(runner), 9);
  std::vector<ReferenceFinger> fingers{{8, {0.025, 0, 0}, Vec3::UnitX()}};
  fingers[0].p_WH = runner[8].X_WB_end * fingers[0].p_BP - 0.002 * Vec3::UnitX();
  runner.step(exchangeOf(fingers, runner));
  EXPECT_EQ(asleep(runner), 7);  // the touched column of two is awake
  EXPECT_FALSE(runner[4].asleep);
  EXPECT_FALSE(runner[8].asleep);
  EXPECT_GT(runner.bodies.fingerForce(0).norm(), 1);
}

// A cube that slides into a sleeping row wakes it in the step of contact: momentum is transferred as if all had been
// awake.
TEST(Sleep, ColliderWakesWhatItMeets) {
  const auto run = [](bool sleeping) {
    OdeOptions options;
    options.method.sleeping = sleeping;
    WorldMaker maker;
    maker.friction(0).table().box(kCube, 0.1, {{0, 0, 0.025}, Quat::Identity()});
    maker.box(kCube, 0.1, {{0.05, 0, 0.025}, Quat::Identity()});
    maker.box(kCube, 0.1, {{-0.8, 0, 0.025}, Quat::Identity()});
    Runner runner(maker.world(), options);
    runner.bodies.setVelocity(3, {0.25, 0, 0}, Vec3::Zero());
    runner.run(2.5);
    EXPECT_EQ(asleep(runner), sleeping ? 2 : 0);
    runner.run(1.5);
    EXPECT_EQ(asleep(runner), 0);
    return std::array<double, 3>{runner[1].v_WB.x(), runner[2].v_WB.x(), runner[3].v_WB.x()};
  };
  const auto with = run(true), without = run(false);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(with[i], without[i], 1e-3);
  EXPECT_NEAR(with[0] + with[1] + with[2], 0.25, 1e-6);
}

// Bodies that move slowly or are held stay awake: a ball rolling at 0.1 mm/s, a box dragged at 0.1 mm/s, a cube in a
// resting grip.
TEST(Sleep, SlowOrHeldBodiesStayAwake) {
  WorldMaker maker;
  maker.table();
  maker.add(Sphere{0.02}, {{0.3, 0, 0.02}, Quat::Identity()}, {0.1, Vec3::Zero(), 1.6e-5 * Mat3::Identity()});
  maker.box(kCube, 0.1, {{0, 0, 0.025}, Quat::Identity()});
  maker.box(kCube, 0.1, {{0, 0.5, 0.5}, Quat::Identity()});
  Runner runner(maker.world());
  const double slow = 1e-4;
  runner.bodies.setVelocity(1, {slow, 0, 0}, {0, slow / 0.02, 0});
  std::vector<ReferenceFinger> fingers = pinch(3, 0.05, 0.002, 1000, 1);
  for (ReferenceFinger& finger : fingers) finger.p_WH += runner[3].X_WB_end.p;
  fingers.emplace_back(2, Vec3(0, 0, 0.025), Vec3::UnitZ());
  for (ReferenceFinger& finger : fingers) finger.damping = 5;
  const Vec3 start = runner[2].X_WB_end * fingers[2].p_BP - 0.001 * Vec3::UnitZ();
  for (int n = 0; n < 2000; ++n) {
    fingers[2].v_WH = slow * Vec3::UnitX();
    fingers[2].p_WH = start + runner.time * fingers[2].v_WH;
    runner.step(exchangeOf(fingers, runner));
    for (std::size_t i = 1; i <= 3; ++i) ASSERT_FALSE(runner[i].asleep) << i << " after " << runner.time;
  }
  EXPECT_NEAR(runner[1].v_WB.x(), slow, 0.01 * slow);
  // released, the box comes to rest and sleeps; the ball rolls on
  runner.run(3);
  EXPECT_TRUE(runner[2].asleep);
  EXPECT_FALSE(runner[1].asleep);
}

}  // namespace
}  // namespace presa::ode
