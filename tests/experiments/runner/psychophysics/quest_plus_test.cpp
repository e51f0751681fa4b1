#include "experiments/runner/psychophysics/quest_plus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/runner/psychophysics/observer.h"

namespace presa::psychophysics {
namespace {

/// Reference implementation straight from the definitions, by other means than QuestPlus: log likelihoods over the
/// whole log, both posteriors built for each level, the distribution function integrated by Simpson's rule.
class BruteForce {
 public:
  static double cdf(double z) {
    constexpr int steps = 20000;
    const double h = z / steps;
    const auto pdf = [](double x) { return std::exp(-x * x / 2) / std::sqrt(2 * std::acos(-1.0)); };
    double sum = pdf(0) + pdf(z);
    for (int i = 1; i < steps; ++i) sum += (i % 2 ? 4 : 2) * pdf(i * h);
    return 0.5 + sum * h / 3;
  }

  BruteForce(const QuestPlusPlan& plan) : levels_(plan.levels) {
    const PosteriorGrid& grid = plan.grid;
    for (std::size_t t = 0; t < grid.threshold.values.size(); ++t) {
      for (const double spread : grid.spread.values) {
        for (const double lapse : grid.lapse.values) {
          const double threshold = grid.threshold.values[t];
          log_prior_.push_back(std::log(grid.threshold.prior[t]));
          thresholds_.push_back(threshold);
          std::vector<double> row;
          for (const double level : levels_) {
            row.push_back(*grid.guess + (1 - *grid.guess - lapse) * cdf((level - threshold) / spread));
          }
          probability_.push_back(row);
        }
      }
    }
  }

  void add(double level, bool positive) {
    log_.emplace_back(static_cast<std::size_t>(std::ranges::find(levels_, level) - levels_.begin()), positive);
  }
  std::vector<double> posterior() const {
    std::vector<double> weights;
    double sum = 0;
    for (std::size_t cell = 0; cell < log_prior_.size(); ++cell) {
      double log_weight = log_prior_[cell];
      for (const auto& [level, positive] : log_) {
        const double p = probability_[cell][level];
        log_weight += std::log(positive ? p : 1 - p);
      }
      sum += weights.emplace_back(std::exp(log_weight));
    }
    for (double& weight : weights) weight /= sum;
    return weights;
  }
  std::vector<double> expectedEntropy() {
    std::vector<double> expected;
    const std::vector<double> now = posterior();
    for (std::size_t level = 0; level < levels_.size(); ++level) {
      double p = 0;
      for (std::size_t cell = 0; cell < now.size(); ++cell) p += now[cell] * probability_[cell][level];
      double entropy = 0;
      for (const bool positive : {true, false}) {
        log_.emplace_back(level, positive);
        for (const double weight : posterior()) entropy -= (positive ? p : 1 - p) * weight * std::log(weight);
        log_.pop_back();
      }
      expected.push_back(entropy);
    }
    return expected;
  }
  double meanThreshold() const {
    double mean = 0;
    const std::vector<double> weights = posterior();
    for (std::size_t cell = 0; cell < weights.size(); ++cell) mean += weights[cell] * thresholds_[cell];
    return mean;
  }

 private:
  std::vector<double> levels_, log_prior_, thresholds_;
  std::vector<std::vector<double>> probability_;
  std::vector<std::pair<std::size_t, bool>> log_;
};

QuestPlusPlan smallPlan() {
  return {.grid = {.threshold = {{0.1, 0.2, 0.3, 0.45}, {1, 2, 2, 0.5}},
                   .spread = {{0.1, 0.2, 0.4}},
                   .lapse = {{0.01, 0.05}}},
          .levels = {0.05, 0.15, 0.25, 0.4, 0.6},
          .stop_trials = 30};
}

TEST(QuestPlus, AgreesWithItsDefinitionWrittenOut) {
  QuestPlus quest(smallPlan());
  BruteForce brute(smallPlan());
  const Observer observer({.location = 0.25, .spread = 0.2, .guess = 0.5, .lapse = 0.03}, Coding::kGreater, 5);
  while (!quest.finished()) {
    const std::vector<double> got = quest.expectedEntropy(), expected = brute.expectedEntropy();
    for (std::size_t level = 0; level < got.size(); ++level) ASSERT_NEAR(got[level], expected[level], 1e-12);
    const auto best = std::ranges::min_element(expected) - expected.begin();
    ASSERT_EQ(quest.next()->level, smallPlan().levels[static_cast<std::size_t>(best)]);
    const Stimulus stimulus = *quest.next();
    quest.respond(observer.answer(quest));
    brute.add(stimulus.level, quest.trials().back().response->positive);
    const std::vector<double> weights = brute.posterior();
    for (std::size_t cell = 0; cell < weights.size(); ++cell) {
      ASSERT_NEAR(quest.posterior().weights()[cell], weights[cell], 1e-12);
    }
    ASSERT_NEAR(quest.posterior().mean(Parameter::kThreshold), brute.meanThreshold(), 1e-12);
  }
  EXPECT_EQ(quest.trials().size(), 30U);
}

TEST(QuestPlus, StopsOnceTheThresholdIsKnownWellEnough) {
  QuestPlusPlan plan = smallPlan();
  plan.stop_sd = 0.08;
  plan.stop_trials = 1000;
  QuestPlus quest(plan);
  const Observer observer({.location = 0.3, .spread = 0.1, .guess = 0.5, .lapse = 0.01}, Coding::kGreater, 5);
  while (!quest.finished()) {
    ASSERT_GT(quest.posterior().sd(Parameter::kThreshold), 0.08);
    quest.respond(observer.answer(quest));
  }
  EXPECT_LE(quest.posterior().sd(Parameter::kThreshold), 0.08);
  EXPECT_LT(quest.trials().size(), 1000U);
}

// With one free parameter QUEST+ is QUEST. With a flat prior, a steep function and no guessing, the best question
// halves the remaining interval, so 6 answers identify one of 64 thresholds.
TEST(QuestPlus, WithOneFreeParameterItBisects) {
  QuestPlusPlan plan{.grid = {.spread = {{1e-3}}, .lapse = {{0.0}}, .guess = 0}, .stop_trials = 6};
  for (int i = 0; i < 64; ++i) plan.grid.threshold.values.push_back(i);
  for (int i = 0; i < 63; ++i) plan.levels.push_back(i + 0.5);
  QuestPlus quest(plan);
  while (!quest.finished()) quest.respond({.positive = quest.next()->level > 22});
  EXPECT_NEAR(quest.posterior().mean(Parameter::kThreshold), 22, 1e-9);
  EXPECT_NEAR(quest.posterior().entropy(), 0, 1e-9);
}

TEST(QuestPlus, EveryMistakeIsNamed) {
  const QuestPlusPlan wrong{.grid = {.threshold = {{2, 1}}, .spread = {{-1.0}}, .lapse = {{0.1, 0.6}, {0, 0}}}};
  EXPECT_EQ(mistakes(wrong).size(), 6U);
  EXPECT_THROW(QuestPlus{wrong}, std::invalid_argument);
}

TEST(Posterior, CountsAndSingleTrialsSayTheSame) {
  Posterior one_by_one(smallPlan().grid), counted(smallPlan().grid);
  for (int i = 0; i < 12; ++i) one_by_one.update(0.25, i < 9);
  for (int i = 0; i < 5; ++i) one_by_one.update(0.4, i < 4);
  counted.update({.x = 0.25, .trials = 12, .hits = 9});
  counted.update({.x = 0.4, .trials = 5, .hits = 4});
  for (std::size_t cell = 0; cell < counted.size(); ++cell) {
    EXPECT_NEAR(counted.weights()[cell], one_by_one.weights()[cell], 1e-13);
  }
}

// Three candidates 0, 1, 2 with weights 1 : 2 : 1 have cells of width 1 from -0.5 to 2.5, so the middle half ends at
// 0.5 and 1.5, and the middle 90 % leaves 0.05, a fifth of a cell, on either side.
TEST(Posterior, CredibleIntervalByHand) {
  const Posterior posterior({.threshold = {{0, 1, 2}, {1, 2, 1}}, .spread = {{1.0}}, .lapse = {{0.0}}});
  EXPECT_DOUBLE_EQ(posterior.mean(Parameter::kThreshold), 1);
  EXPECT_DOUBLE_EQ(posterior.sd(Parameter::kThreshold), std::sqrt(0.5));
  EXPECT_NEAR(posterior.credible(Parameter::kThreshold, 0.5).low, 0.5, 1e-12);
  EXPECT_NEAR(posterior.credible(Parameter::kThreshold, 0.5).high, 1.5, 1e-12);
  EXPECT_NEAR(posterior.credible(Parameter::kThreshold, 0.9).low, -0.3, 1e-12);
  EXPECT_NEAR(posterior.credible(Parameter::kThreshold, 0.9).high, 2.3, 1e-12);
  EXPECT_EQ(posterior.credible(Parameter::kSpread, 0.9).low, 1);
}

// A wrong key press at a level where every candidate excludes that answer must not make the posterior vanish.
TEST(Posterior, SurvivesAnImpossibleAnswer) {
  Posterior posterior({.threshold = {{0, 1}}, .spread = {{0.01}}, .lapse = {{0.0}}, .guess = 0});
  posterior.update(50, false);
  EXPECT_DOUBLE_EQ(posterior.mean(Parameter::kThreshold), 0.5);
}

// "Which was heavier?": a lapse gives either answer, so P runs from lapse to 1 - lapse.
TEST(Posterior, WithoutAGuessRateItIsTheLapseRate) {
  const Posterior posterior({.threshold = {{0.0}}, .spread = {{1.0}}, .lapse = {{0.1}}, .guess = std::nullopt});
  EXPECT_NEAR(posterior.probability(0, -50), 0.1, 1e-12);
  EXPECT_NEAR(posterior.probability(0, 0), 0.5, 1e-12);
  EXPECT_NEAR(posterior.probability(0, 50), 0.9, 1e-12);
}

// Weight discrimination in two intervals, 7 levels x 20 answers. An independent simplex fit finds the maximum of the
// likelihood at 0.199219 kg and spread 0.023810; with a flat prior the posterior peaks at one of the two adjacent
// candidates.
TEST(Posterior, PeaksAtTheMaximumOfTheLikelihood) {
  PosteriorGrid grid{.lapse = {{0.0, 0.004, 0.02}}, .guess = std::nullopt};
  for (int i = 0; i < 41; ++i) grid.threshold.values.push_back(0.19 + 0.0005 * i);
  for (int i = 0; i < 31; ++i) grid.spread.values.push_back(0.015 + 0.0005 * i);
  Posterior posterior(grid);
  const std::vector<double> levels{0.160, 0.172, 0.184, 0.200, 0.216, 0.228, 0.240};
  const std::vector<int> heavier{1, 3, 5, 10, 15, 18, 19};
  for (std::size_t i = 0; i < levels.size(); ++i) {
    posterior.update({.x = levels[i], .trials = 20, .hits = heavier[i]});
  }
  const auto best =
      static_cast<std::size_t>(std::ranges::max_element(posterior.weights()) - posterior.weights().begin());
  EXPECT_NEAR(grid.threshold.values[best / 3 / 31], 0.199219, 0.0005);
  EXPECT_NEAR(grid.spread.values[best / 3 % 31], 0.02381, 0.0005);
}

}  // namespace
}  // namespace presa::psychophysics
