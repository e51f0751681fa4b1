// Hits between bodies, against free fall: when, how fast, which two, and none where nothing hits.
#include <gmock/gmock.h>

#include "tests/modules/dynamics_ode/support.h"

namespace presa::ode {
namespace {

constexpr double kFallerRadius = 0.01, kFallerMass = 0.03, kFall = 0.2;
constexpr std::size_t kHitRoom = 64;  // hits

std::vector<BodyHit> hitsOf(const Runner& runner) {
  std::vector<BodyHit> all;
  std::uint64_t next = 0;
  runner.bodies.hits().read(next, [&](const BodyHit& hit) {
    all.push_back(hit);
    return true;
  });
  return all;
}

class Hits : public testing::TestWithParam<DynamicsSettings::Solver> {
 protected:
  OdeOptions options() const {
    OdeOptions options;
    options.method.solver = GetParam();
    return options;
  }
};

// The speed is that before the step, so that up to a step of gravity is missing; the time is that of the closed gap,
// without the gravity within the step: g h^2 / 2 over the speed, and less than a step.
TEST_P(Hits, OfAFallingBallAreThoseOfFreeFall) {
  Runner runner(WorldMaker().table().ball(kFallerRadius, kFallerMass, {0.02, 0, kFallerRadius + kFall}).world(),
                options());
  runner.bodies.listen(kHitRoom);
  while (runner.time < 1) runner.step();
  const std::vector<BodyHit> hits = hitsOf(runner);
  ASSERT_EQ(hits.size(), 1);
  const BodyHit& hit = hits[0];
  const double speed = std::sqrt(2 * kGravity * kFall), time = std::sqrt(2 * kFall / kGravity);
  EXPECT_EQ(hit.A, 0);
  EXPECT_EQ(hit.B, 1);
  EXPECT_LE(hit.speed, speed + 1e-9);
  EXPECT_GT(hit.speed, speed - 2 * kGravity * kStep);
  EXPECT_NEAR(hit.time, time, kStep);
  EXPECT_NEAR((hit.p_W - Vec3(0.02, 0, 0)).norm(), 0, 2 * speed * kStep);
  EXPECT_NEAR(hit.nhat_AB_W.z(), 1, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(BySolver, Hits,
                         testing::Values(DynamicsSettings::Solver::kAuto, DynamicsSettings::Solver::kSmallSteps,
                                         DynamicsSettings::Solver::kDirect, DynamicsSettings::Solver::kIterative));

// Newton's law of impact: each hit has e times the speed of the one before, to a step of gravity.
TEST(BodyHits, OfABouncingBallSlowDown) {
  constexpr double kRestitution = 0.7;
  Runner runner(WorldMaker()
                    .bouncing(kRestitution)
                    .table()
                    .ball(kFallerRadius, kFallerMass, {0, 0, kFallerRadius + kFall})
                    .world());
  runner.bodies.listen(kHitRoom);
  while (runner.time < 1.5) runner.step();
  const std::vector<BodyHit> hits = hitsOf(runner);
  ASSERT_GE(hits.size(), 4);
  for (std::size_t i = 1; i < 4; ++i)
    EXPECT_NEAR(hits[i].speed / hits[i - 1].speed, kRestitution, 2 * kGravity * kStep / hits[i - 1].speed) << i;
}

// A pile that has settled, a ball that rolls, a cube that slides: contacts all the time, and no hit.
TEST(BodyHits, AreNoneWhereBodiesRestRollOrSlide) {
  Runner runner(WorldMaker()
                    .table()
                    .ball(kFallerRadius, kFallerMass, {0, 0.2, kFallerRadius})
                    .box({0.04, 0.04, 0.04}, 0.1, {{0, 0, 0.02}, Quat::Identity()})
                    .box({0.04, 0.04, 0.04}, 0.1, {{0, 0, 0.06}, Quat::Identity()})
                    .box({0.04, 0.04, 0.04}, 0.1, {{0, -0.2, 0.02}, Quat::Identity()})
                    .world());
  runner.bodies.listen(kHitRoom);
  runner.bodies.setVelocity(1, {0.2, 0, 0}, {0, 0.2 / kFallerRadius, 0});
  runner.bodies.setVelocity(4, {0.3, 0, 0}, Vec3::Zero());
  while (runner.time < 1) runner.step();
  EXPECT_GT(runner[1].X_WB_end.p.x(), 0.1);
  EXPECT_GT(runner[4].X_WB_end.p.x(), 0.003);
  EXPECT_EQ(runner.bodies.hits().count(), 0U);
}

TEST(BodyHits, AreNotLookedForUnlessSomebodyListens) {
  Runner runner(WorldMaker().table().ball(kFallerRadius, kFallerMass, {0, 0, kFallerRadius + kFall}).world());
  while (runner.time < 1) runner.step();
  EXPECT_EQ(runner.bodies.hits().count(), 0U);
}

BodyHit hitAt(double time, double speed, std::int32_t A = 0, std::int32_t B = 1) {
  return {.time = time, .A = A, .B = B, .speed = speed};
}

// One impact that the solver stops in two steps counts once; another pair, a later or a faster one counts.
TEST(BodyHits, OfOnePairCountOnceWithinAFewSteps) {
  BodyHits hits(kHitRoom);
  hits.add(hitAt(1, 0.3));
  hits.add(hitAt(1.005, 0.2));
  hits.add(hitAt(1.005, 0.2, 1, 0));
  EXPECT_EQ(hits.count(), 1U);
  hits.add(hitAt(1.005, 0.2, 0, 2));
  hits.add(hitAt(1.01, 0.4));
  hits.add(hitAt(1.05, 0.2));
  EXPECT_EQ(hits.count(), 4U);
}

TEST(BodyHits, AreReadOnceInOrderAndThoseLostAreCounted) {
  BodyHits hits(kHitRoom);
  std::uint64_t next = 0;
  std::vector<double> heard;
  const auto hear = [&](const BodyHit& hit) { return hit.time < 50 && (heard.push_back(hit.time), true); };
  for (int i = 0; i < 3; ++i) hits.add(hitAt(i, 1));
  EXPECT_EQ(hits.read(next, hear), 0U);
  EXPECT_EQ(hits.read(next, hear), 0U);
  EXPECT_THAT(heard, testing::ElementsAre(0, 1, 2));
  for (int i = 3; i < 100; ++i) hits.add(hitAt(i, 1));
  EXPECT_EQ(hits.read(next, hear), 100 - 3 - kHitRoom);
  EXPECT_EQ(heard.size(), 3 + 50 - (100 - kHitRoom));
  EXPECT_EQ(next, 50U);  // refused, and offered again
}

}  // namespace
}  // namespace presa::ode
