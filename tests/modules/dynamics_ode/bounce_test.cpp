#include "framework/core/math/random.h"
#include "tests/modules/dynamics_ode/support.h"

// Restitution against Newton's and Coulomb's laws of impact, and energy that never rises.
namespace presa::ode {
namespace {

constexpr double kBallRadius = 0.01, kBallMass = 0.03;

/// A ball over a table, its lowest point at `height`.
std::shared_ptr<const World> ballOver(double height, double restitution) {
  return WorldMaker().bouncing(restitution).table().ball(kBallRadius, kBallMass, {0, 0, kBallRadius + height}).world();
}

double heightOf(const Runner& runner, std::size_t body = 1) { return runner[body].X_WB_end.p.z() - kBallRadius; }

/// Highest point after each of `bounces`.
std::vector<double> apexes(Runner& runner, int bounces) {
  std::vector<double> all;
  bool rises = false;
  while (static_cast<int>(all.size()) < bounces && runner.time < 60) {
    const double before = heightOf(runner);
    const bool rose = rises;
    runner.step();
    rises = runner[1].v_WB.z() > 0;
    if (rose && !rises) all.push_back(std::max(before, heightOf(runner)));
  }
  return all;
}

// 0.03 mm: the fall from the apex in half a step, g h^2 / 8; 0.1 %: the meeting speed by the height at the step before.
TEST(Bounce, ABallRisesToTheSquareOfItsRestitution) {
  constexpr double kHeight = 0.3;
  for (const double restitution : {0.3, 0.8, 0.95}) {
    Runner runner(ballOver(kHeight, restitution));
    double wanted = kHeight;
    for (const double apex : apexes(runner, 3)) {
      wanted *= restitution * restitution;
      EXPECT_NEAR(apex, wanted, 4e-5 + 1e-3 * kHeight) << "restitution " << restitution;
    }
    EXPECT_LT(runner.state.energy.sum, 1e-6 * kBallMass * kGravity * kHeight);
  }
}

TEST(Bounce, AnElasticBallKeepsItsHeightForTwentyBounces) {
  constexpr double kHeight = 0.3;
  Runner runner(ballOver(kHeight, 1));
  const std::vector<double> all = apexes(runner, 20);
  ASSERT_EQ(all.size(), 20);
  EXPECT_NEAR(all.back(), kHeight, 0.02 * kHeight);  // 0.1 % a bounce
  EXPECT_LT(*std::max_element(all.begin(), all.end()), kHeight + 1e-9);
}

// Zeno: infinitely many bounces end after t (1 + e) / (1 - e), with the time t of the first fall. Each bounce is late by
// up to a step; those slower than two steps of gravity are left out.
TEST(Bounce, InfinitelyManyBouncesEnd) {
  constexpr double kHeight = 0.3, kRestitution = 0.5;
  Runner runner(ballOver(kHeight, kRestitution));
  const double first = std::sqrt(2 * kHeight / kGravity);
  double last_moved = 0;
  while (runner.time < 4) {
    runner.step();
    if (runner[1].v_WB.norm() > 1e-3) last_moved = runner.time;
  }
  EXPECT_NEAR(last_moved, first * (1 + kRestitution) / (1 - kRestitution), 0.03);
  EXPECT_TRUE(runner[1].asleep);
  EXPECT_NEAR(heightOf(runner), 0, 1e-6);
}

// Friction of the whole impulse m (1 + e) v_n slows the ball by at most mu of that, or until it rolls: 5/7 of its speed.
TEST(Bounce, AnObliqueBallIsSlowedByFriction) {
  constexpr double kRestitution = 0.6;
  for (const double mu : {0.05, 0.1, 1.0}) {
    Runner runner(WorldMaker()
                      .gravity(Vec3::Zero())
                      .friction(mu)
                      .bouncing(kRestitution)
                      .table()
                      .ball(kBallRadius, kBallMass, {0, 0, kBallRadius + 0.0123})
                      .world());
    runner.bodies.setVelocity(1, {1, 0, -1}, Vec3::Zero());
    runner.run(0.1);
    const double slowed = std::max(1 - mu * (1 + kRestitution), 5.0 / 7);
    EXPECT_NEAR(runner[1].v_WB.x(), slowed, 2e-3) << mu;
    EXPECT_NEAR(runner[1].v_WB.z(), kRestitution, 1e-6) << mu;
    EXPECT_NEAR(runner[1].w_WB.y(), 2.5 * (1 - slowed) / kBallRadius, 0.5) << mu;
  }
}

TEST(Bounce, ABallHandsItsVelocityToItsEqual) {
  Runner runner(WorldMaker()
                    .gravity(Vec3::Zero())
                    .bouncing(1)
                    .ball(kBallRadius, kBallMass, {0, 0, 0})
                    .ball(kBallRadius, kBallMass, {0.0517, 0, 0})
                    .world());
  runner.bodies.setVelocity(0, {1, 0, 0}, Vec3::Zero());
  runner.run(0.2);
  EXPECT_NEAR(runner[0].v_WB.x(), 0, 1e-6);
  EXPECT_NEAR(runner[1].v_WB.x(), 1, 1e-6);
}

TEST(Bounce, AFlatCubeDoesNotTurn) {
  Runner runner(WorldMaker().bouncing(0.5).table().box(kCube, 0.1, {{0, 0, 0.125}, Quat::Identity()}).world());
  double fastest_up = 0;
  while (runner.time < 0.3) {
    runner.step();
    fastest_up = std::max(fastest_up, runner[1].v_WB.z());
    EXPECT_LT(runner[1].w_WB.norm(), 1e-6);
  }
  EXPECT_NEAR(fastest_up, 0.5 * std::sqrt(2 * kGravity * 0.1), 2e-3);
}

// Where friction and several corners act at once Newton's law of impact alone may create energy.
TEST(Bounce, ThrownBoxesGainNoEnergy) {
  RandomStream random(1, "thrown");
  for (int i = 0; i < 40; ++i) {
    const Quat turned = Quat(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
    Runner runner(WorldMaker()
                      .friction(random.uniform(0, 1))
                      .bouncing(random.uniform(0.5, 1))
                      .table()
                      .box({0.05, 0.03, 0.02}, 0.1, {{0, 0, 0.1}, turned})
                      .box({0.05, 0.05, 0.02}, 0.1, {{0.01, 0, 0.2}, turned})
                      .world());
    runner.bodies.setVelocity(1, {random.normal(), random.normal(), -1},
                              10 * Vec3(random.normal(), 1, random.normal()));
    runner.run(3);
    EXPECT_LT(runner.state.energy.sum, 2e-3) << i;  // of some 0.4 J
  }
}

}  // namespace
}  // namespace presa::ode
