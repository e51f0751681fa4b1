// Recovery: does a method find the truth, with the right uncertainty? 500 observers with psychometric functions drawn
// from the prior answer each method. In that case theory says exactly: the posterior mean is unbiased, the squared
// error over the posterior variance has mean 1, and a credible interval of mass c covers the truth with probability c.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "experiments/runner/psychophysics/forced_choice.h"
#include "experiments/runner/psychophysics/interleaved.h"
#include "experiments/runner/psychophysics/observer.h"
#include "experiments/runner/psychophysics/quest_plus.h"
#include "tests/experiments/runner/psychophysics/binomial_range.h"

namespace presa::psychophysics {
namespace {

using statistics::PsychometricFunction;
using statistics::StimulusLevel;

constexpr int kObservers = 500;

std::vector<double> evenly(double low, double high, std::size_t count) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(low + (high - low) * static_cast<double>(i) / static_cast<double>(count - 1));
  }
  return values;
}

/// Two intervals, ln-ratio to the standard; truths are drawn from this prior.
PosteriorGrid grid() {
  return {.threshold = {evenly(0.10, 0.50, 41)}, .spread = {{0.05, 0.1, 0.2, 0.3}}, .lapse = {{0.0, 0.02, 0.04}}};
}

PsychometricFunction drawTruth(RandomStream& stream) {
  return {.location = stream.uniform(0.095, 0.505),  // the outer cells extend half a step beyond the candidates
          .spread = grid().spread.values[stream.below(4)],
          .guess = 0.5,
          .lapse = grid().lapse.values[stream.below(3)]};
}

/// The posterior after one observer's session.
using Session = std::function<Posterior(const Observer&, std::uint64_t seed)>;

Posterior questPlus(const Observer& observer, std::uint64_t seed) {
  auto method =
      std::make_unique<QuestPlus>(QuestPlusPlan{.grid = grid(), .levels = evenly(0.02, 0.80, 40), .stop_trials = 60});
  const QuestPlus& quest = *method;
  ForcedChoice task(std::move(method), {}, RandomStream(seed, "places"));
  while (!task.finished()) task.respond(observer.answer(task));
  return quest.posterior();
}

Posterior interleavedStaircases(const Observer& observer, std::uint64_t seed) {
  const StaircaseRule rule{.start = 0.8,
                           .steps_up = {0.20, 0.10},
                           .change_after = 4,
                           .down = 3,
                           .down_up_ratio = 0.7393,
                           .min = 0,
                           .stop_reversals = 8,
                           .stop_trials = 60};
  const InterleavedPlan plan{.tracks = onBothSides(rule, 2), .catch_rate = 0.05, .catch_level = 1};
  ForcedChoice task(std::make_unique<Interleaved>(plan, RandomStream(seed, "interleave")), {},
                    RandomStream(seed, "places"));
  while (!task.finished()) task.respond(observer.answer(task));
  Posterior posterior(grid());
  for (const StimulusLevel& count : tally(task.trials(), Coding::kCorrect)) posterior.update(count);
  return posterior;
}

struct Case {
  const char* name;
  Session session;
};

class Recovery : public testing::TestWithParam<Case> {};

// Bounds: five standard errors of the means (of z^2: sqrt(2 / n) for normal z), the 99.9 % range of the binomial counts.
TEST_P(Recovery, PosteriorIsUnbiasedAndAsWideAsItsError) {
  double error = 0, squared_error = 0, squared_z = 0;
  int covered_95 = 0, covered_50 = 0;
  for (std::uint64_t seed = 0; seed < kObservers; ++seed) {
    RandomStream stream(2026, "truths", seed);
    const Observer observer(drawTruth(stream), Coding::kCorrect, seed);
    const Posterior posterior = GetParam().session(observer, seed);
    const double truth = observer.function().location;
    const double off = posterior.mean(Parameter::kThreshold) - truth;
    error += off, squared_error += off * off;
    squared_z += std::pow(off / posterior.sd(Parameter::kThreshold), 2);
    const auto covers = [&](double mass) { return posterior.credible(Parameter::kThreshold, mass).contains(truth); };
    covered_95 += covers(0.95), covered_50 += covers(0.5);
  }
  const double rms = std::sqrt(squared_error / kObservers);
  RecordProperty("rms_error", std::to_string(rms));
  RecordProperty("covered_95", covered_95);
  RecordProperty("covered_50", covered_50);
  EXPECT_NEAR(error / kObservers, 0, 5 * rms / std::sqrt(kObservers));
  EXPECT_LT(rms, 0.41 / std::sqrt(12)) << "no better than the prior";
  EXPECT_NEAR(squared_z / kObservers, 1, 5 * std::sqrt(2.0 / kObservers));
  for (const auto& [mass, covered] : {std::pair(0.95, covered_95), std::pair(0.5, covered_50)}) {
    const BinomialRange range = binomialRange(kObservers, mass, 0.999);
    EXPECT_GE(covered, range.low) << "of mass " << mass;
    EXPECT_LE(covered, range.high) << "of mass " << mass;
  }
}

// Under one fixed truth, as in a laboratory, the coverage need not be exactly nominal, but must not be lower. The
// spread lies between two candidates. Bound: the 99.9 % range of the binomial count.
TEST_P(Recovery, IntervalCoversAGivenTruth) {
  const PsychometricFunction truth{.location = 0.3, .spread = 0.15, .guess = 0.5, .lapse = 0.01};
  int covered = 0;
  for (std::uint64_t seed = 0; seed < kObservers; ++seed) {
    const Observer observer(truth, Coding::kCorrect, seed);
    covered += GetParam().session(observer, seed).credible(Parameter::kThreshold, 0.95).contains(truth.location);
  }
  RecordProperty("covered_95", covered);
  EXPECT_GE(covered, binomialRange(kObservers, 0.95, 0.999).low);
}

INSTANTIATE_TEST_SUITE_P(Methods, Recovery,
                         testing::Values(Case{"QuestPlus", questPlus},
                                         Case{"InterleavedStaircases", interleavedStaircases}),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace presa::psychophysics
