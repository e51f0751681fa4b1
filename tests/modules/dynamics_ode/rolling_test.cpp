#include "tests/modules/dynamics_ode/support.h"

// Rolling resistance against the equation of a rolling ball: (7/5) m r a = -m g length.
namespace presa::ode {
namespace {

constexpr double kRollRadius = 0.02, kRollMass = 0.1;

class Rolling : public ::testing::TestWithParam<DynamicsSettings::Solver> {
 protected:
  static OdeOptions options() {
    OdeOptions options;
    options.method.solver = GetParam();
    return options;
  }
  /// A ball on a table; a pair has the sum of both materials' lengths.
  static std::shared_ptr<const World> world(double length, double slope = 0) {
    return WorldMaker()
        .gravity(kGravity * Vec3(std::sin(slope), 0, -std::cos(slope)))
        .rolling(length / 2)
        .table()
        .ball(kRollRadius, kRollMass, {0, 0, kRollRadius})
        .world();
  }
};

// 3 %: the way of half a step, h v / 2, at the start and at the end.
TEST_P(Rolling, ABallStopsAfterItsWay) {
  constexpr double kLength = 1e-3, kSpeed = 0.2;
  Runner runner(world(kLength), options());
  runner.bodies.setVelocity(1, {kSpeed, 0, 0}, {0, kSpeed / kRollRadius, 0});
  runner.run(2);
  const double slowing = 5.0 / 7 * kGravity * kLength / kRollRadius;
  EXPECT_NEAR(runner[1].X_WB_end.p.x(), kSpeed * kSpeed / (2 * slowing), 0.03 * kSpeed * kSpeed / (2 * slowing));
  EXPECT_TRUE(runner[1].asleep);
}

TEST_P(Rolling, WithoutResistanceABallRollsOn) {
  constexpr double kSpeed = 0.2;
  Runner runner(world(0), options());
  runner.bodies.setVelocity(1, {kSpeed, 0, 0}, {0, kSpeed / kRollRadius, 0});
  runner.run(2);
  EXPECT_NEAR(runner[1].v_WB.x(), kSpeed, 1e-3);
}

TEST_P(Rolling, ABallStandsOnASlopeUpToItsLimit) {
  constexpr double kLength = 2e-3;
  const double limit = std::atan(kLength / kRollRadius);
  Runner stands(world(kLength, 0.95 * limit), options());
  stands.run(3);
  EXPECT_LT((stands[1].X_WB_end.p - Vec3(0, 0, kRollRadius)).norm(), 1e-5);

  const double slope = 1.5 * limit;
  Runner rolls(world(kLength, slope), options());
  rolls.run(1);
  const double speeding = 5.0 / 7 * kGravity * (std::sin(slope) - kLength / kRollRadius * std::cos(slope));
  EXPECT_NEAR(rolls[1].v_WB.x(), speeding, 0.01 * speeding);
}

// The moment that holds a ball turns the plank under it: nothing outside acts on both about a vertical through them.
TEST_P(Rolling, TheMomentActsOnBothBodies) {
  WorldMaker maker;
  maker.gravity({0, 0, 0}).rolling(1e-3).box({0.2, 0.2, 0.02}, 0.1, {{0, 0, -0.01}, Quat::Identity()});
  maker.ball(kRollRadius, kRollMass, {0, 0, kRollRadius});
  Runner runner(maker.world(), options());
  runner.bodies.setVelocity(1, {0, 0, -0.1}, {0, 5, 0});
  const auto momentum = [&] {
    Vec3 all = Vec3::Zero();
    const double inertias[] = {0, 0.4 * kRollMass * kRollRadius * kRollRadius};
    for (const std::size_t i : {0, 1}) {
      const Mat3 inertia = i == 0 ? boxInertia(0.1, {0.2, 0.2, 0.02}) : Mat3(inertias[1] * Mat3::Identity());
      const BodyMotion& body = runner[i];
      all += 0.1 * body.X_WB_end.p.cross(body.v_WB) +
             body.X_WB_end.q * (inertia * (body.X_WB_end.q.conjugate() * body.w_WB));
    }
    return all;
  };
  runner.bodies.write(0, runner.state);
  const Vec3 before = momentum();
  runner.run(0.05);
  EXPECT_LT((momentum() - before).norm(), 0.01 * before.norm());
}

INSTANTIATE_TEST_SUITE_P(Solvers, Rolling,
                         ::testing::Values(DynamicsSettings::Solver::kNewton, DynamicsSettings::Solver::kSmallSteps));

}  // namespace
}  // namespace presa::ode
