#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/runner/definition/reaction.h"
#include "framework/core/math/random.h"
#include "tests/support/alloc_lock_guard.h"

// Reaction times measured in signals with a known onset.
namespace presa::experiment {
namespace {

constexpr double kTickPeriod = 0.001;
constexpr std::size_t kWait = 0, kReact = 1;

class ReactionTest : public testing::Test {
 protected:
  Reaction rule(double threshold, double sds) {
    return {*Expression::compile("x", SymbolTable({"x"}), {}, diagnostics), kWait, kReact, threshold, sds, 0.2};
  }
  /// Onset found by the clock after all samples of both phases.
  static double onsetOf(const Reaction& rule, const std::vector<double>& wait, const std::vector<double>& react) {
    ReactionClock clock(rule, kTickPeriod);
    for (const double x : wait) clock.add(kWait, {&x, 1}, 0);
    for (std::size_t n = 0; n < react.size(); ++n)
      clock.add(kReact, {&react[n], 1}, static_cast<double>(n) * kTickPeriod);
    return clock.onset();
  }
  Diagnostics diagnostics;
};

struct Lines {
  double left, response;
};
Lines linesOf(const std::vector<double>& wait, double threshold, double sds) {
  const std::vector<double> window(wait.end() - 200, wait.end());
  double mean = 0, squares = 0;
  for (const double x : window) mean += x / 200;
  for (const double x : window) squares += (x - mean) * (x - mean);
  const double sd = std::sqrt(squares / 199), response = mean + std::max(threshold, sds * sd);
  return {std::min(mean + 2 * sd, response), response};
}
/// The documented rule as a backward search in all stored samples.
double searchedBackwards(const std::vector<double>& react, const Lines& lines) {
  const auto response = std::find_if(react.begin(), react.end(), [&](double x) { return x > lines.response; });
  if (response == react.end()) return std::numeric_limits<double>::quiet_NaN();
  auto onset = response;
  while (onset != react.begin() && *(onset - 1) > lines.left) --onset;
  return static_cast<double>(onset - react.begin()) * kTickPeriod;
}

/// A grip of 2 N with white noise, which rises from sample 150 of the reaction phase on.
struct Rise {
  static constexpr double kSd = 0.02, kSlope = 4;  // [N], [N/s]: a rise of a fifth of the noise sd per sample
  static constexpr int kDelay = 150;
  static double height(int n) { return std::max(0, n - kDelay) * kTickPeriod * kSlope; }
  explicit Rise(std::uint64_t seed) {
    RandomStream noise(seed, "noise");
    for (int n = 0; n < 700; ++n) wait.push_back(2 + kSd * noise.normal());
    for (int n = 0; n < 600; ++n) react.push_back(2 + height(n) + kSd * noise.normal());
  }
  std::vector<double> wait, react;
};

// The online rule without stored samples gives the bit-exact result of the search in all samples.
TEST_F(ReactionTest, IsTheSearchBackwardsWithoutTheSamples) {
  for (const double threshold : {0.0, 0.2}) {
    const Reaction what = rule(threshold, 5);
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
      const Rise rise(seed);
      ASSERT_EQ(onsetOf(what, rise.wait, rise.react), searchedBackwards(rise.react, linesOf(rise.wait, threshold, 5)));
    }
  }
}

// White noise on a ramp: sample n is below the lower line, m + 2 s, with probability p(n) = Phi(2 - height / s), and
// the onset follows the last such sample. Its mean is the sum over n of P(onset > n) = 1 - product over k >= n of (1 -
// p(k)). m and s are estimated from 200 samples, with errors s / sqrt(200) and s / sqrt(400): these shift the line by
// less than 0.1 s + 0.1 s, half a sample, in either direction, and negligibly in the mean of 2000 runs. Tolerance: 4
// standard errors of that mean.
TEST_F(ReactionTest, OnAverageFindsTheBeginningOfARampInNoise) {
  const auto below = [](int n) { return 0.5 * std::erfc((Rise::height(n) / Rise::kSd - 2) / std::sqrt(2)); };
  double expected = Rise::kDelay, never_again = 1;
  std::vector<double> later;
  for (int n = 599; n >= Rise::kDelay; --n) later.push_back(1 - (never_again *= 1 - below(n)));
  for (const double p : later) expected += p;
  const Reaction what = rule(0.2, 5);
  constexpr int kRuns = 2000;
  double mean = 0, squares = 0;
  for (int run = 1; run <= kRuns; ++run) {
    const Rise rise(static_cast<std::uint64_t>(run));
    const double change = onsetOf(what, rise.wait, rise.react) / kTickPeriod - mean;
    mean += change / run;
    squares += change * (onsetOf(what, rise.wait, rise.react) / kTickPeriod - mean);
  }
  const double error = std::sqrt(squares / (kRuns - 1) / kRuns);
  EXPECT_LT(error, 0.15);  // [samples]: otherwise the comparison would be weak
  EXPECT_NEAR(mean, expected, 4 * error);
  EXPECT_LT(expected - Rise::kDelay, 25);  // 2 s are 10 samples of the ramp, and the noise adds as many
}

// Without noise the onset is the first sample after the start of the ramp, for every threshold.
TEST_F(ReactionTest, FindsAQuietRampToTheSample) {
  std::vector<double> react(600, 2.0);
  for (int n = 150; n < 600; ++n) react[static_cast<std::size_t>(n)] += 0.004 * (n - 150);
  EXPECT_EQ(onsetOf(rule(0.2, 5), std::vector<double>(300, 2.0), react), 0.151);
  EXPECT_EQ(onsetOf(rule(1.5, 5), std::vector<double>(300, 2.0), react), 0.151);
}

TEST_F(ReactionTest, IsNothingWhereNothingRises) {
  EXPECT_TRUE(std::isnan(onsetOf(rule(0.2, 5), std::vector<double>(300, 2.0), std::vector<double>(600, 2.19))));
  EXPECT_TRUE(std::isnan(onsetOf(rule(0.2, 5), {2.0}, std::vector<double>(600, 9.0)))) << "no baseline";
  EXPECT_TRUE(std::isnan(onsetOf(rule(0.2, 5), std::vector<double>(300, 2.0), {}))) << "the phase never came";
}

// With an unsteady grip of sd 0.1 N, five sds (0.5 N) exceed the threshold of 0.2 N.
TEST_F(ReactionTest, TakesTheLargerOfTheThresholds) {
  std::vector<double> wait;
  for (int n = 0; n < 300; ++n) wait.push_back(n % 2 == 0 ? 1.9 : 2.1);
  EXPECT_TRUE(std::isnan(onsetOf(rule(0.2, 5), wait, std::vector<double>(600, 2.45))));
  EXPECT_EQ(onsetOf(rule(0.2, 4), wait, std::vector<double>(600, 2.45)), 0);
}

// Only the end of the baseline counts. A rise before the event has its onset at 0, to be discarded as an anticipation.
TEST_F(ReactionTest, LooksAtTheLastOfTheBaselineAndNotBeforeTheEvent) {
  std::vector<double> wait(1000, 7.0);
  std::fill(wait.end() - 200, wait.end(), 2.0);
  EXPECT_EQ(onsetOf(rule(0.2, 5), wait, {2.0, 2.1, 2.3}), 0.001);
  EXPECT_EQ(onsetOf(rule(0.2, 5), wait, {2.1, 2.3}), 0);
}

TEST_F(ReactionTest, TakesNoMemory) {
  const Reaction what = rule(0.2, 5);
  const Rise rise(1);
  ReactionClock clock(what, kTickPeriod);
  const RealTimeGuard guard;
  for (const double& x : rise.wait) clock.add(kWait, {&x, 1}, 0);
  for (const double& x : rise.react) clock.add(kReact, {&x, 1}, 0.1);
  EXPECT_EQ(guard.violations(), 0) << guard.first();
  EXPECT_EQ(clock.onset(), 0.1);
}

}  // namespace
}  // namespace presa::experiment
