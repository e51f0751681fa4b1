// Regression tests for typical mistakes of a grip model.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/devices/simulated_subject/study.h"

namespace presa::subject {
namespace {

Afferents holding(double height, double seen) {
  Afferents afferents;
  for (DigitAfferents& digit : afferents.digits) digit = {.q = 2e-3, .y = height, .normal = 2, .load = 1};
  afferents.sight = {.object = true, .height = seen};
  return afferents;
}

// The fingers settle after a lift. A slip detector that starts too early takes their drift for a slip, and the subject
// remembers a grip at which nothing slipped. Heavy slippery cubes drift most.
TEST(Traps, NoSlipIsNoticedThatHasNotBegun) {
  for (const Level level : {Level::kL0, Level::kL1, Level::kL2}) {
    const Population population(level);
    for (std::uint64_t subject = 0; subject < 40; ++subject) {
      const SubjectParameters parameters = population.draw(2, subject);
      for (const double stiffness : {500.0, 1000.0, 2000.0}) {
        const Cube cube{.mass = 0.4, .mu_s = 0.4, .mu_d = 0.3, .stiffness = stiffness};
        StandAlone world(parameters, {.cube = cube, .subject = subject, .resolution = 90e-6});
        while (world.brain().phase() <= Phase::kLoosen) ASSERT_TRUE(world.step());
        EXPECT_FALSE(std::isnan(world.result().notice_delay))
            << nameOf(level) << ", subject " << subject << ", k " << stiffness;
      }
    }
  }
}

// At friction 0.4 a grip that follows the felt load is too late: it must follow the commanded lift.
TEST(Traps, GripGoesAheadWithTheLiftThatIsCommanded) {
  Brain brain(Population(Level::kL0).draw(1, 0), {}, RandomStream(1, "perception"), 1e-3);
  Afferents afferents = holding(0, 0);
  for (DigitAfferents& digit : afferents.digits) digit.load = 0;
  while (brain.phase() != Phase::kLoad) brain.step(afferents);
  afferents.effort = 1;
  for (int i = 0; i < 100; ++i) brain.step(afferents);
  // 1 + 3.25 N/N, approached to exp(-100 ms / 20 ms)
  EXPECT_NEAR(brain.command().grip, 4.25, 3.25 * std::exp(-5));
}

// With soft skin and strong muscles the grip builds up late and the cube slides. The lift must wait, or the fingers
// leave the cube on the table and the subject remembers the grip of an empty hand.
TEST(Traps, TheCubeComesAlongWhenLifted) {
  const Population population(Level::kL0);
  for (std::uint64_t subject = 0; subject < 60; ++subject) {
    const Cube cube{.mass = 0.4, .mu_s = 0.4, .mu_d = 0.3, .stiffness = 500};
    StandAlone world(population.draw(3, subject), {.cube = cube, .subject = subject, .resolution = 90e-6});
    while (world.brain().phase() <= Phase::kSettle) ASSERT_TRUE(world.step());
    EXPECT_GT(world.cubeHeight(), 0.01) << "subject " << subject;  // lost: 30 mm below the fingers at 40 mm
  }
}

// A hand that sinks together with its object has not lost it; an object that stays while the hand rises is lost.
TEST(Traps, LostIsRelativeToTheFingers) {
  Perception perception(1e-3);
  for (int i = 0; i < 1000; ++i) perception.step(holding(0.04, 0));
  for (int i = 0; i < 1000; ++i) perception.step(holding(-0.10, 0));
  EXPECT_FALSE(perception.lost());
  for (int i = 0; i < 100; ++i) perception.step(holding(0.04, -0.04));
  EXPECT_TRUE(perception.lost());
}

// Stiffness and weight are felt, not given: the just noticeable difference of stiffness is 23 %, the estimate is within
// 5 %.
TEST(Traps, StiffnessAndWeightAreFelt) {
  for (const Level level : {Level::kL0, Level::kL1, Level::kL2}) {
    const SubjectParameters parameters = Population(level).draw(4, 0);
    for (const Cube& cube : studyCubes()) {
      StandAlone world(parameters, {.cube = cube, .seed = 4, .resolution = 90e-6});
      while (world.brain().phase() <= Phase::kSettle) ASSERT_TRUE(world.step());
      EXPECT_NEAR(world.brain().perception().stiffness() / cube.stiffness, 1, 0.05) << nameOf(level);
      EXPECT_NEAR(world.brain().perception().load() / (cube.mass * Cube::kGravity / 2), 1, 0.05) << nameOf(level);
    }
  }
}

// Opening fingers still touch the released object: that is not the next grasp.
TEST(Traps, LettingGoForgetsWhereTheObjectWasUntilItIsTouchedAnew) {
  Perception perception(1e-3);
  const auto live = [&](const Afferents& afferents) {
    for (int i = 0; i < 500; ++i) perception.step(afferents);
  };
  live(holding(0.04, 0));
  perception.release();
  live(holding(0.04, -0.04));
  EXPECT_EQ(perception.fallen(), 0);
  Afferents open = holding(0.04, -0.04);
  for (DigitAfferents& digit : open.digits) digit.normal = digit.load = 0;
  live(open);
  live(holding(0, 0));
  EXPECT_FALSE(perception.lost());
  live(holding(0.04, -0.04));
  EXPECT_TRUE(perception.lost());
}

TEST(Traps, WithEyesClosedTheCubeIsLostWhenNothingIsTouched) {
  Perception perception(1e-3);
  Afferents afferents = holding(0.04, -0.04);
  afferents.sight = {};
  perception.step(afferents);
  EXPECT_FALSE(perception.lost());
  for (DigitAfferents& digit : afferents.digits) digit.normal = 0;
  perception.step(afferents);
  EXPECT_TRUE(perception.lost());
}

TEST(Traps, ReachingMeetsTheCubeGently) {
  const Cube cube{.mass = 0.2, .mu_s = 0.8, .mu_d = 0.6, .stiffness = 1000};
  StandAlone world(Population(Level::kL0).draw(1, 1), {.cube = cube, .subject = 1, .resolution = 90e-6, .reach = 0.02});
  EXPECT_EQ(world.brain().phase(), Phase::kReach);
  EXPECT_EQ(world.hand().q(0), -0.02);
  while (world.brain().phase() == Phase::kReach) ASSERT_TRUE(world.step());
  EXPECT_LT(world.result().peak, 0.5);
  const TrialResult result = world.run();
  EXPECT_TRUE(result.completed);
  EXPECT_GT(result.grip, cube.slipForce());
}

}  // namespace
}  // namespace presa::subject
