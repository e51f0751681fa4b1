#include "experiments/runner/statistics/psychometric.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace presa::statistics {
namespace {

using Levels = std::vector<StimulusLevel>;

/// Standard 0.200 kg, "the comparison is heavier"; x in kg.
const Levels kWeight{{.160, 20, 1},  {.172, 20, 3},  {.184, 20, 5}, {.200, 20, 10},
                     {.216, 20, 15}, {.228, 20, 18}, {.240, 20, 19}};
/// 2AFC, correct; x is the step of the stiffness in percent.
const Levels kStiffness{{5, 40, 22}, {10, 40, 25}, {15, 40, 29}, {20, 40, 33}, {30, 40, 37}, {40, 40, 39}};

const PsychometricModel kGreater{PsychometricShape::kNormal, std::nullopt};
const PsychometricModel kForcedChoice{PsychometricShape::kNormal, 0.5};

PsychometricModel withLapse(PsychometricModel model, double lapse) {
  model.lapse = lapse;
  return model;
}

// The reference is another implementation (scipy): -lnL to 1e-4, PSE and spread to 1 %. The lapse is not compared,
// because the likelihood is flat in it. With a fixed lapse the minimum is sharp and all given digits agree.
TEST(Psychometric, WeightOfTheNote) {
  const PsychometricFit fit = *fitPsychometric(kWeight, kGreater).fit;
  EXPECT_NEAR(fit.negative_log_likelihood, 59.339273, 1e-4);
  EXPECT_NEAR(*fit.function.pse(), 0.199219, 0.01 * 0.199219);
  EXPECT_NEAR(fit.function.spread, 0.023810, 0.01 * 0.023810);
  EXPECT_NEAR(fit.function.jnd(), 0.016059, 0.01 * 0.016059);
  EXPECT_NEAR(fit.function.jnd() / fit.function.spread, 0.674490, 5e-7);
  EXPECT_EQ(fit.function.guess, fit.function.lapse);
  EXPECT_EQ(fit.parameters, 3U);

  const PsychometricFit no_lapse = *fitPsychometric(kWeight, withLapse(kGreater, 0)).fit;
  EXPECT_NEAR(no_lapse.negative_log_likelihood, 59.340027, 1e-6);
  EXPECT_NEAR(no_lapse.function.location, 0.199222, 1e-6);
  EXPECT_NEAR(no_lapse.function.spread, 0.024206, 1e-6);
  EXPECT_NEAR(no_lapse.deviance, 0.17445, 1e-5);
  EXPECT_GT(*no_lapse.deviance_p, 0.99);  // 5 degrees of freedom
}

TEST(Psychometric, StiffnessOfTheNote) {
  const PsychometricFit fit = *fitPsychometric(kStiffness, kForcedChoice).fit;
  EXPECT_NEAR(fit.negative_log_likelihood, 111.497451, 1e-4);
  EXPECT_NEAR(fit.function.location, 16.0627, 0.01 * 16.0627);
  EXPECT_NEAR(fit.function.spread, 10.1491, 0.01 * 10.1491);
  EXPECT_NEAR(*fit.function.threshold(0.75), 16.6919, 0.01 * 16.6919);

  const PsychometricFit fixed = *fitPsychometric(kStiffness, withLapse(kForcedChoice, 0.02)).fit;
  EXPECT_NEAR(fixed.negative_log_likelihood, 111.502621, 1e-6);
  EXPECT_NEAR(fixed.function.location, 16.2110, 1e-4);
  EXPECT_NEAR(fixed.function.spread, 10.4232, 1e-4);
}

class EveryShape : public testing::TestWithParam<PsychometricShape> {};
INSTANTIATE_TEST_SUITE_P(Psychometric, EveryShape,
                         testing::Values(PsychometricShape::kNormal, PsychometricShape::kLogistic,
                                         PsychometricShape::kWeibull));

TEST_P(EveryShape, ThresholdInvertsProbability) {
  const PsychometricFunction f{GetParam(), 12, 0.4, 0.5, 0.03};
  for (const double p : {0.51, 0.6, 0.75, 0.9, 0.969}) EXPECT_NEAR(f.probability(*f.threshold(p)), p, 1e-12);
  for (const double p : {0.5, 0.97, 1.0, 0.0, std::numeric_limits<double>::quiet_NaN()}) EXPECT_FALSE(f.threshold(p));
  const PsychometricFunction whole{GetParam(), 12, 0.4};
  EXPECT_NEAR(whole.jnd(), 0.5 * (*whole.threshold(0.75) - *whole.threshold(0.25)), 1e-12);
}

// The counts equal their expectation, so the likelihood has its maximum at the truth, in any unit of x.
TEST_P(EveryShape, FindsTheTruthBehindExactCounts) {
  for (const double unit : {1e-3, 1.0, 1e6}) {
    const double spread = GetParam() == PsychometricShape::kWeibull ? 0.4 : 3 * unit;
    const PsychometricFunction truth{GetParam(), 14 * unit, spread, 0.5, 0.02};
    Levels levels;
    for (const double x : {5.0, 9.0, 12.0, 15.0, 18.0, 25.0, 40.0}) {
      constexpr int kTrials = 100000000;
      levels.push_back({x * unit, kTrials, static_cast<int>(std::lround(kTrials * truth.probability(x * unit)))});
    }
    const PsychometricResult result = fitPsychometric(levels, {GetParam(), 0.5});
    ASSERT_EQ(result.verdict, FitVerdict::kFitted) << words(result.verdict);
    EXPECT_NEAR(result.fit->function.location / truth.location, 1, 1e-5);
    EXPECT_NEAR(result.fit->function.spread / truth.spread, 1, 1e-5);
    EXPECT_NEAR(result.fit->function.lapse, truth.lapse, 1e-6);
  }
}

TEST(Psychometric, OrderAndSplitOfLevelsDoNotMatter) {
  Levels split = kWeight;
  std::reverse(split.begin(), split.end());
  split[3] = {.200, 5, 1};
  split.push_back({.200, 15, 9});
  split.push_back({.5, 0, 0});
  const PsychometricFit whole = *fitPsychometric(kWeight, kGreater).fit;
  const PsychometricFit parts = *fitPsychometric(split, kGreater).fit;
  EXPECT_EQ(parts.function.location, whole.function.location);
  EXPECT_EQ(parts.function.spread, whole.function.spread);
  EXPECT_EQ(parts.deviance, whole.deviance);
  EXPECT_EQ(parts.levels, 7U);
}

TEST(Psychometric, SaysWhyThereIsNoFit) {
  const auto verdict = [](const Levels& levels, const PsychometricModel& model = kGreater) {
    const PsychometricResult result = fitPsychometric(levels, model);
    EXPECT_EQ(result.fit.has_value(), result.verdict == FitVerdict::kFitted);
    EXPECT_FALSE(std::string(words(result.verdict)).empty());
    return result.verdict;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(verdict({{1, 10, 10}, {2, 10, 10}}), FitVerdict::kAllHits);
  EXPECT_EQ(verdict({{1, 10, 0}, {2, 10, 0}}), FitVerdict::kNoHits);
  EXPECT_EQ(verdict({{1, 10, 5}, {1, 10, 6}}), FitVerdict::kOneLevel);
  EXPECT_EQ(verdict({{1, 10, 0}, {2, 10, 0}, {3, 10, 10}, {4, 10, 10}}), FitVerdict::kStep);
  EXPECT_EQ(verdict({{1, 10, 0}, {2, 10, 0}, {3, 10, 4}, {4, 10, 10}}), FitVerdict::kStep);
  EXPECT_EQ(verdict({{1, 10, 9}, {2, 10, 5}, {3, 10, 1}}), FitVerdict::kFlat);
  EXPECT_EQ(verdict({{1, 100, 75}, {2, 100, 75}, {3, 100, 75}}, kForcedChoice), FitVerdict::kFlat);
  EXPECT_EQ(verdict({}), FitVerdict::kBadInput);
  EXPECT_EQ(verdict({{1, 0, 0}, {2, 0, 0}}), FitVerdict::kBadInput);
  EXPECT_EQ(verdict({{1, 10, 11}, {2, 10, 5}}), FitVerdict::kBadInput);
  EXPECT_EQ(verdict({{1, 10, -1}, {2, 10, 5}}), FitVerdict::kBadInput);
  EXPECT_EQ(verdict({{nan, 10, 1}, {2, 10, 5}}), FitVerdict::kBadInput);
  EXPECT_EQ(verdict({{0, 10, 1}, {2, 10, 5}}, {PsychometricShape::kWeibull, 0.5}), FitVerdict::kBadInput);
  EXPECT_EQ(verdict(kWeight, withLapse(kGreater, 0.5)), FitVerdict::kBadInput);
  EXPECT_EQ(verdict(kWeight, withLapse(kGreater, -0.1)), FitVerdict::kBadInput);
  EXPECT_EQ(verdict({{1, 10, 1}, {2, 10, 5}, {3, 10, 9}}), FitVerdict::kFitted);
}

TEST(PsychometricBootstrap, IsReproducibleAndRefusesWhatItCannotDo) {
  const PsychometricFit fit = *fitPsychometric(kStiffness, kForcedChoice).fit;
  const auto run = [&](std::uint64_t seed, std::size_t draws, double level = 0.95, double p = 0.75) {
    RandomStream random(seed, "bootstrap");
    return bootstrapPsychometric(kStiffness, kForcedChoice, fit, std::array{p, 0.8}, draws, level, random);
  };
  const PsychometricBootstrap once = *run(1, 200), again = *run(1, 200), other = *run(2, 200);
  EXPECT_EQ(once.thresholds[0].low, again.thresholds[0].low);
  EXPECT_NE(once.thresholds[0].low, other.thresholds[0].low);
  EXPECT_TRUE(once.thresholds[0].contains(*fit.function.threshold(0.75)));
  EXPECT_TRUE(once.location.contains(fit.function.location));
  EXPECT_TRUE(once.jnd.contains(fit.function.jnd()));
  EXPECT_GT(once.deviance_p, 0.5);  // these counts are closer to the curve than most would be
  EXPECT_EQ(once.draws, 200U);
  EXPECT_EQ(once.undetermined, 0U);
  EXPECT_FALSE(run(1, 19));
  EXPECT_FALSE(run(1, 200, 1));
  EXPECT_FALSE(run(1, 200, 0.95, 0.5));
  EXPECT_FALSE(run(1, 200, 0.95, 0.95));
  RandomStream random(1, "bootstrap");
  EXPECT_FALSE(bootstrapPsychometric(kStiffness, {PsychometricShape::kLogistic, 0.5}, fit, {}, 200, 0.95, random));
}

// Standard error of the 2IFC point of subjective equality from the Fisher information at the fit: the bootstrap
// interval must have the same width within 15 % (the percentiles of 500 draws are accurate to about 7 %).
TEST(PsychometricBootstrap, WidthAgreesWithFisherInformation) {
  const PsychometricModel model = withLapse(kGreater, 0);
  const PsychometricFit fit = *fitPsychometric(kWeight, model).fit;
  double information = 0;  // location and spread are orthogonal here: the levels are nearly symmetric
  for (const StimulusLevel& level : kWeight) {
    const double z = (level.x - fit.function.location) / fit.function.spread, p = fit.function.probability(level.x);
    const double density = std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi) / fit.function.spread;
    information += level.trials * density * density / (p * (1 - p));
  }
  RandomStream random(11, "bootstrap");
  const PsychometricBootstrap bootstrap = *bootstrapPsychometric(kWeight, model, fit, {}, 500, 0.95, random);
  EXPECT_NEAR(bootstrap.location.halfWidth() * std::sqrt(information) / 1.959964, 1, 0.15);
}

// 500 observers of known threshold: 90 % intervals cover 90 % within three binomial standard deviations (4 %), and the
// p of the deviance is below 0.1 no more often than 10 %. A fit underestimates the spread with few trials, and its
// bootstrap draws do so again, so the percentile interval is known to cover two or three percent less.
TEST(PsychometricBootstrap, CoversAsOftenAsItSays) {
  constexpr int kObservers = 500;
  const PsychometricFunction truth{PsychometricShape::kNormal, 0.2, 0.024};
  int pse_covered = 0, jnd_covered = 0, rejected = 0;
  for (int observer = 0; observer < kObservers; ++observer) {
    RandomStream random(12, "observer", static_cast<std::uint64_t>(observer));
    Levels levels = kWeight;
    for (StimulusLevel& level : levels) {
      level.trials = 40, level.hits = 0;
      for (int i = 0; i < level.trials; ++i) level.hits += random.uniform() < truth.probability(level.x);
    }
    const PsychometricModel model = withLapse(kGreater, 0);
    const PsychometricFit fit = *fitPsychometric(levels, model).fit;
    const PsychometricBootstrap bootstrap =
        *bootstrapPsychometric(levels, model, fit, std::array{0.5}, 99, 0.9, random);
    pse_covered += bootstrap.thresholds[0].contains(truth.location);
    jnd_covered += bootstrap.jnd.contains(truth.jnd());
    rejected += bootstrap.deviance_p <= 0.1;
  }
  const double tolerance = 3 * std::sqrt(0.9 * 0.1 / kObservers);
  EXPECT_NEAR(pse_covered / double{kObservers}, 0.9, tolerance);
  EXPECT_NEAR(jnd_covered / double{kObservers}, 0.9 - 0.025, tolerance);
  EXPECT_NEAR(rejected / double{kObservers}, 0.1, tolerance);
}

}  // namespace
}  // namespace presa::statistics
