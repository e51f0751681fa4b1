// The one number of the model that mechanics determines: a cube slips at m g / (2 mu_s), for every subject.
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/runner/statistics/correlation.h"
#include "experiments/runner/statistics/ranks.h"
#include "tests/devices/simulated_subject/study.h"

namespace presa::subject {
namespace {

constexpr double kSlow = 0.1;  // [1/s] loosening

// The grip falls by kSlow x 1 ms = 0.01 % per step, and the first slip is the first sample after the crossing: below
// the line by at most that (positions are not quantised here).
constexpr double kStep = kSlow * StandAlone::kPeriod;

class SlipLine : public testing::TestWithParam<Level> {};

TEST_P(SlipLine, FirstSlipIsAtTheBoundOfStaticFrictionForEveryCubeAndSubject) {
  Population population = withoutNoise(GetParam());
  population.set("loosening", constant(kSlow));
  for (std::uint64_t subject = 0; subject < 4; ++subject) {
    const SubjectParameters parameters = population.draw(1, subject);
    for (const Cube& cube : studyCubes()) {
      const TrialResult result = StandAlone(parameters, {.cube = cube}).run();
      ASSERT_TRUE(result.completed);
      EXPECT_NEAR(result.slip_force / cube.slipForce(), 1 - kStep / 2, kStep / 2)
          << "subject " << subject << ", m " << cube.mass << ", mu_s " << cube.mu_s << ", k " << cube.stiffness;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, SlipLine, testing::Values(Level::kL0, Level::kL1, Level::kL2),
                         [](const auto& level) { return std::string(nameOf(level.param)); });

// The rank correlations of the balanced design are exact: +sqrt(75/118), -11/sqrt(354) and 0, for any number of
// repeats.
TEST(SlipLine, CorrelatesWithTheFactorsAsTheRanksSay) {
  std::vector<double> force, mass, friction, stiffness;
  for (const Cube& cube : studyCubes()) {
    force.push_back(cube.slipForce());
    mass.push_back(cube.mass);
    friction.push_back(cube.mu_s);
    stiffness.push_back(cube.stiffness);
  }
  force = statistics::toLevels(force);
  EXPECT_NEAR(*statistics::spearman(force, mass), std::sqrt(75.0 / 118), 1e-14);
  EXPECT_NEAR(*statistics::spearman(force, friction), -11 / std::sqrt(354.0), 1e-14);
  EXPECT_NEAR(*statistics::spearman(force, stiffness), 0, 1e-14);
}

// A sliding cube stops only at m g / (2 mu_d): the grip at which it sticks again is above the slip line.
TEST(SlipLine, AProxyThatSlidesSticksAgainOnlyWithinTheDynamicCone) {
  const Cube cube{.mass = 0.2, .mu_s = 0.8, .mu_d = 0.6, .stiffness = 1000};
  DigitContact contact;
  contact.step(cube, 10, 1e-3, 0);  // 1 N
  EXPECT_EQ(contact.state(), DigitContact::State::kStick);
  contact.step(cube, 10, 1e-3, 0.79e-3);
  EXPECT_EQ(contact.state(), DigitContact::State::kStick);
  EXPECT_DOUBLE_EQ(contact.load(), 0.79);
  contact.step(cube, 10, 1e-3, 0.81e-3);
  EXPECT_EQ(contact.state(), DigitContact::State::kSlip);
  EXPECT_TRUE(contact.slipBegan());
  EXPECT_DOUBLE_EQ(contact.load(), 0.6);
  contact.step(cube, 10, 1.01e-3, 0.81e-3 + 0.0059e-3);  // 0.6059 N, cone 0.606 N
  EXPECT_EQ(contact.state(), DigitContact::State::kStick);
  contact.step(cube, 10, 0, 0);
  EXPECT_EQ(contact.state(), DigitContact::State::kFree);
}

}  // namespace
}  // namespace presa::subject
