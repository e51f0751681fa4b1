#include "experiments/runner/statistics/resampling.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "experiments/runner/statistics/correlation.h"
#include "experiments/runner/statistics/distributions.h"
#include "experiments/runner/statistics/means.h"
#include "tests/experiments/runner/statistics/grip_design.h"

namespace presa::statistics {
namespace {

using Values = std::vector<double>;

// Two of the 24 orders of four values are as extreme as the perfect one: p = 1/12 within four binomial standard
// deviations.
TEST(SpearmanPermutation, CountsOrders) {
  const Values x{1, 2, 3, 4};
  RandomStream random(1, "orders");
  const PermutationTest test = *spearmanPermutation(x, x, std::array{0, 0, 0, 0}, 20000, random);
  EXPECT_EQ(test.rho, 1);
  EXPECT_NEAR(static_cast<double>(test.hits) / 20000, 1 / 12.0, 4 * std::sqrt(11.0 / 144 / 20000));
  EXPECT_EQ(test.p, static_cast<double>(1 + test.hits) / 20001);
}

TEST(SpearmanPermutation, LeavesStrataOfOneAlone) {
  const Values x{1, 2, 3, 4};
  RandomStream random(1, "alone");
  EXPECT_EQ(spearmanPermutation(x, x, std::array{1, 2, 3, 4}, 50, random)->p, 1);
}

TEST(SpearmanPermutation, SameSeedSameResultAndRefusals) {
  const GripDesign design(2);
  Values force;
  RandomStream noise(3, "force");
  for (const double slip : design.slip) force.push_back(slip * std::exp(noise.normal()));
  const auto p = [&](std::uint64_t seed) {
    RandomStream random(seed, "shuffle");
    return spearmanPermutation(force, design.stiffness, std::vector<int>(54), 500, random)->p;
  };
  EXPECT_EQ(p(1), p(1));
  EXPECT_NE(p(1), p(2));
  RandomStream random(1, "shuffle");
  EXPECT_FALSE(spearmanPermutation(force, Values(54, 1.0), std::vector<int>(54), 500, random));
  EXPECT_FALSE(spearmanPermutation(force, design.mass, std::vector<int>(53), 500, random));
  EXPECT_FALSE(spearmanPermutation(force, design.mass, std::vector<int>(54), 0, random));
}

// Distribution of rho over shuffles of 162 trials against a factor of three levels: variance 1/161 (tolerance: four
// times sqrt(2/N), the relative standard error of a variance of N draws), 95 % point 0.1542 (tolerance: four standard
// errors of 0.001 each, from the density there).
TEST(SpearmanPermutation, NullDistributionOfTheGripStudy) {
  constexpr int kShuffles = 20000;
  const GripDesign design(6);
  Values order(162), sizes;
  for (std::size_t i = 0; i < 162; ++i) order[i] = static_cast<double>(i);
  RandomStream random(4, "null");
  double squares = 0;
  for (int i = 0; i < kShuffles; ++i) {
    random.shuffle(std::span<double>(order));
    const double rho = *spearman(order, design.stiffness);
    squares += rho * rho, sizes.push_back(std::abs(rho));
  }
  EXPECT_NEAR(squares / kShuffles * 161, 1, 4 * std::sqrt(2.0 / kShuffles));
  EXPECT_NEAR(*quantile(sizes, 0.95), 0.1542, 0.004);
}

// x and y are related only through differences between three subjects. Chi-square over ten classes of p, 9 degrees of
// freedom: 27.9 is its 99.9 % point. The test that treats the 60 trials as independent calls most of these significant.
TEST(SpearmanPermutation, IsUniformWhenOnlySubjectsDiffer) {
  constexpr int kRuns = 1000;
  std::array<int, 10> classes{};
  int naive = 0;
  for (int run = 0; run < kRuns; ++run) {
    RandomStream random(5, "null", static_cast<std::uint64_t>(run));
    Values x, y;
    std::vector<int> subjects;
    for (int i = 0; i < 60; ++i) {
      subjects.push_back(i % 3);
      x.push_back(i % 3 + random.normal()), y.push_back(i % 3 + random.normal());
    }
    const double p = spearmanPermutation(x, y, subjects, 99, random)->p;  // 0.01, 0.02 … 1
    ++classes[static_cast<std::size_t>(std::lround(100 * p) - 1) / 10];
    naive += spearmanTest(x, y)->p < 0.05;
  }
  double chi_square = 0;
  for (const int count : classes) chi_square += std::pow(count - kRuns / 10.0, 2) / (kRuns / 10.0);
  EXPECT_LT(chi_square, 27.9);
  EXPECT_GT(naive, kRuns / 2);
}

TEST(BootstrapIntervals, LieBetweenPercentiles) {
  Values draws(1001);
  for (std::size_t i = 0; i < draws.size(); ++i) draws[i] = static_cast<double>((2 * i) % 1001) / 1000;
  EXPECT_NEAR(percentileInterval(draws, 0.9)->low, 0.05, 1e-12);
  EXPECT_NEAR(percentileInterval(draws, 0.9)->high, 0.95, 1e-12);
  EXPECT_FALSE(percentileInterval(Values{}, 0.9));
  EXPECT_FALSE(percentileInterval(draws, 0));
  EXPECT_FALSE(percentileInterval(draws, 1));
}

TEST(BootstrapSubjects, SaysWhyNotBelowEight) {
  std::vector<int> subjects(std::size_t{54} * 7);
  for (std::size_t i = 0; i < subjects.size(); ++i) subjects[i] = static_cast<int>(i / 54);
  RandomStream random(1, "bootstrap");
  const TrialStatistic one = [](auto) { return 1.0; }, none = [](auto) { return std::optional<double>(); };
  const SubjectBootstrap few = bootstrapSubjects(subjects, one, 100, 0.95, random);
  EXPECT_FALSE(few.interval);
  EXPECT_NE(std::string(few.why_not).find("8 subjects"), std::string::npos);
  EXPECT_EQ(few.subjects, 7U);
  subjects.push_back(7);
  EXPECT_TRUE(bootstrapSubjects(subjects, one, 100, 0.95, random).interval);
  const SubjectBootstrap empty = bootstrapSubjects(subjects, none, 100, 0.95, random);
  EXPECT_FALSE(empty.interval);
  EXPECT_EQ(empty.undefined, 100U);
  EXPECT_FALSE(bootstrapSubjects(subjects, one, 0, 0.95, random).interval);
}

TEST(BootstrapSubjects, DrawsWholeSubjects) {
  const std::vector<int> subjects{0, 0, 0, 1, 2, 3, 4, 5, 6, 7};
  RandomStream random(2, "bootstrap");
  int draws = 0;
  bootstrapSubjects(
      subjects,
      [&](std::span<const std::size_t> trials) {
        std::array<int, 10> times{};
        for (const std::size_t trial : trials) ++times[trial];
        EXPECT_EQ(times[0], times[1]);
        EXPECT_EQ(times[0], times[2]);
        EXPECT_EQ(trials.size(), 8U + 2U * static_cast<std::size_t>(times[0]));
        ++draws;
        return 0.0;
      },
      200, 0.95, random);
  EXPECT_EQ(draws, 200);
}

// The percentile interval of a mean of N normal values is mean +- 1.96 sd sqrt((N - 1) / N) / sqrt N, so its coverage
// is P(|T(N - 1)| < 1.96 sqrt((N - 1) / N)): 92.9 % with 20 subjects, 89.0 % with 8. Tolerance: three binomial standard
// deviations of 600 runs plus 1 % for percentiles of 199 draws.
TEST(BootstrapSubjects, CoversAsOftenAsTheorySays) {
  constexpr int kRuns = 600;
  for (const std::size_t n : {8U, 20U}) {
    const double df = static_cast<double>(n - 1);
    const double expected = 1 - studentTwoSidedP(1.959964 * std::sqrt(df / static_cast<double>(n)), df);
    int covered = 0;
    for (int run = 0; run < kRuns; ++run) {
      RandomStream random(6, "subjects", static_cast<std::uint64_t>(run));
      Values values(n);
      std::vector<int> subjects(n);
      for (std::size_t i = 0; i < n; ++i) values[i] = 3 + random.normal(), subjects[i] = static_cast<int>(i);
      const TrialStatistic mean_of = [&](std::span<const std::size_t> trials) -> std::optional<double> {
        double sum = 0;
        for (const std::size_t trial : trials) sum += values[trial];
        return sum / static_cast<double>(trials.size());
      };
      covered += bootstrapSubjects(subjects, mean_of, 199, 0.95, random).interval->contains(3);
    }
    EXPECT_NEAR(covered / double{kRuns}, expected, 3 * std::sqrt(expected * (1 - expected) / kRuns) + 0.01) << n;
  }
}

}  // namespace
}  // namespace presa::statistics
