#include "experiments/runner/psychophysics/staircase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "experiments/runner/psychophysics/observer.h"

namespace presa::psychophysics {
namespace {

using statistics::PsychometricFunction;

/// The levels presented for a sequence of answers: '+' positive, '-' negative.
std::vector<double> levels(Staircase& staircase, const std::string& answers) {
  std::vector<double> presented;
  for (const char answer : answers) {
    presented.push_back(staircase.next().value().level);
    staircase.respond({.positive = answer == '+'});
  }
  return presented;
}

void expectLevels(const std::vector<double>& got, const std::vector<double>& expected) {
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i], expected[i], 1e-12) << "trial " << i + 1;
}

// Worked by hand: two positive answers in a row give a step down, one negative gives a step up, and each step restarts
// the count. The step out of the second reversal still has the old size.
TEST(Staircase, TwoDownOneUpByHand) {
  Staircase staircase({.start = 10, .steps_up = {2, 1}, .change_after = 2, .down = 2, .stop_trials = 100});
  expectLevels(levels(staircase, "++++-+-++++"), {10, 10, 8, 8, 6, 8, 8, 10, 10, 8, 8});
  EXPECT_EQ(staircase.next()->level, 7);
  EXPECT_EQ(staircase.reversals(), (std::vector<double>{6, 10}));
  EXPECT_EQ(staircase.threshold(2), 8);
  EXPECT_EQ(staircase.threshold(3), std::nullopt);
}

TEST(Staircase, DownStepsAreTheRatioOfUpSteps) {
  Staircase staircase({.start = 1, .steps_up = {0.4}, .down = 1, .down_up_ratio = 0.5, .stop_trials = 9});
  expectLevels(levels(staircase, "+-+"), {1, 0.8, 1.2});
  EXPECT_DOUBLE_EQ(staircase.next()->level, 1.0);
}

TEST(Staircase, InitialRuleStepsDownAtEachAnswerUntilTheFirstReversal) {
  Staircase staircase({.start = 9, .steps_up = {1}, .down = 3, .one_down_first = true, .stop_trials = 99});
  expectLevels(levels(staircase, "++-+++"), {9, 8, 7, 8, 8, 8});
  EXPECT_EQ(staircase.next()->level, 7);
}

TEST(Staircase, StaysBetweenItsLimits) {
  Staircase staircase({.start = 1, .steps_up = {1}, .min = 0.5, .max = 1.5, .stop_trials = 9});
  expectLevels(levels(staircase, "++--+"), {1, 0.5, 0.5, 1.5, 1.5});
}

TEST(Staircase, StopsByReversalsOrTrialsWhicheverComesFirst) {
  const StaircaseRule rule{.start = 5, .steps_up = {1}, .stop_reversals = 2, .stop_trials = 4};
  Staircase by_reversals(rule);
  levels(by_reversals, "+-+");
  EXPECT_TRUE(by_reversals.finished());
  Staircase by_trials(rule);
  levels(by_trials, "++++");
  EXPECT_TRUE(by_trials.finished());
  EXPECT_THROW(by_trials.respond({}), std::logic_error);
}

TEST(Staircase, BelowTheStandardLevelsAreMirrored) {
  Staircase staircase({.start = 3, .steps_up = {1}, .stop_trials = 9, .side = -1});
  expectLevels(levels(staircase, "+-"), {-3, -2});
  EXPECT_EQ(staircase.reversals(), std::vector<double>{2});
}

// Levitt 1971 for equal steps; Garcia-Perez 1998 for the ratios; Kaernbach 1991: p = up / (up + down).
TEST(Staircase, TargetProportions) {
  const auto target = [](std::size_t down, double ratio) {
    return StaircaseRule{.down = down, .down_up_ratio = ratio}.targetProportion();
  };
  EXPECT_NEAR(target(2, 1), 0.7071, 5e-5);
  EXPECT_NEAR(target(3, 1), 0.7937, 5e-5);
  EXPECT_NEAR(target(2, 0.5488), 0.8035, 5e-5);
  EXPECT_NEAR(target(3, 0.7393), 0.8315, 5e-5);
  EXPECT_DOUBLE_EQ(weightedUpDown(0.75).targetProportion(), 0.75);
  EXPECT_DOUBLE_EQ(weightedUpDown(0.75).down_up_ratio, 1.0 / 3);
}

TEST(Staircase, EveryMistakeIsNamed) {
  const StaircaseRule wrong{
      .start = 2, .steps_up = {0.1, -1}, .change_after = 0, .down = 0, .down_up_ratio = 0, .max = 1, .side = 0};
  EXPECT_EQ(mistakes(wrong).size(), 7U);
  EXPECT_THROW(Staircase{wrong}, std::invalid_argument);
}

struct Simulated {
  double mean = 0, sd = 0;
};

/// 2000 runs; P(correct) = Phi(0.6745 d / 0.23).
Simulated simulate(const StaircaseRule& rule, std::size_t last) {
  const PsychometricFunction function{.spread = 0.23 / 0.6745};
  constexpr int runs = 2000;
  double s1 = 0, s2 = 0;
  for (std::uint64_t run = 0; run < runs; ++run) {
    Staircase staircase(rule);
    const Observer observer(function, Coding::kGreater, run);
    while (!staircase.finished()) staircase.respond(observer.answer(staircase));
    const double threshold = staircase.threshold(last).value();
    s1 += threshold, s2 += threshold * threshold;
  }
  return {s1 / runs, std::sqrt((s2 - s1 * s1 / runs) / (runs - 1))};
}

struct Expected {
  std::size_t down;
  double ratio, mean;
};
class StaircaseLevels : public testing::TestWithParam<Expected> {};

// An independent simulation (numpy, 2000 runs each, d >= 0) gave these means with an SD of about 0.08. Both values are
// sample means: the bound is five standard errors of their difference plus half of the last digit printed; likewise for
// the SD.
TEST_P(StaircaseLevels, AgreeWithAnIndependentSimulation) {
  const auto [down, ratio, mean] = GetParam();
  const Simulated got = simulate({.start = 0.8,
                                  .steps_up = {0.20, 0.10},
                                  .change_after = 4,
                                  .down = down,
                                  .down_up_ratio = ratio,
                                  .min = 0,
                                  .stop_reversals = 12,
                                  .stop_trials = 1000},
                                 8);
  EXPECT_NEAR(got.mean, mean, 5 * 0.08 * std::sqrt(2.0 / 2000) + 5e-4);
  EXPECT_NEAR(got.sd, 0.08, 5 * 0.08 / std::sqrt(2 * 2000.0) + 5e-3);
}

INSTANTIATE_TEST_SUITE_P(Rules, StaircaseLevels,
                         testing::Values(Expected{2, 0.5488, 0.313}, Expected{3, 0.7393, 0.338}, Expected{2, 1, 0.204},
                                         Expected{3, 1, 0.282}));

}  // namespace
}  // namespace presa::psychophysics
