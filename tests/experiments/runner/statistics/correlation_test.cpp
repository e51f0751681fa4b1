#include "experiments/runner/statistics/correlation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "framework/core/math/random.h"
#include "tests/experiments/runner/statistics/grip_design.h"

namespace presa::statistics {
namespace {

using Values = std::vector<double>;

// 27, 54 and 162 trials: repeats do not change the correlation of a balanced design.
TEST(Correlation, OfTheSlipForceIsExact) {
  for (const int repeats : {1, 2, 6}) {
    const GripDesign design(repeats);
    for (const Values& force : {toLevels(design.slip), toLevels(design.sliding)}) {
      EXPECT_NEAR(*spearman(force, design.mass), std::sqrt(75.0 / 118), 1e-12);
      EXPECT_NEAR(*spearman(force, design.mu_s), -11 / std::sqrt(354.0), 1e-12);
      EXPECT_NEAR(*spearman(force, design.stiffness), 0, 1e-12);
    }
    const Values force = toLevels(design.slip);
    EXPECT_NEAR(*kendallTauB(force, design.mass), 0.693103, 5e-7);
    EXPECT_NEAR(*kendallTauB(force, design.mu_s), -0.495074, 5e-7);
    EXPECT_EQ(*kendallTauB(force, design.stiffness), 0);
    EXPECT_NEAR(*pearson(force, design.mass), 0.713024, 5e-7);
    EXPECT_NEAR(*pearson(force, design.mu_s), -0.594089, 5e-7);
    EXPECT_NEAR(*pearson(force, design.stiffness), 0, 1e-12);
  }
}

// Bound for a response without ties against a balanced factor of three levels: sqrt(8/9 n^2 / (n^2 - 1)). The squared
// correlations with the three orthogonal factors add up to at most 1.
TEST(Correlation, TiesOfABalancedFactorBoundIt) {
  const auto largest = [](const GripDesign& of) {
    Values tie_free = of.mass;
    for (std::size_t i = 0; i < tie_free.size(); ++i) tie_free[i] += 1e-6 * static_cast<double>(i);
    return *spearman(tie_free, of.mass);
  };
  const GripDesign design;
  EXPECT_NEAR(largest(design), 0.943456, 5e-7);
  EXPECT_NEAR(largest(GripDesign(100)), std::sqrt(8.0 / 9), 1e-7);

  const auto sum_of_squares = [&](const Values& force) {
    double sum = 0;
    for (const Values* factor : {&design.mass, &design.mu_s, &design.stiffness}) {
      sum += std::pow(*spearman(force, *factor), 2);
    }
    return sum;
  };
  EXPECT_NEAR(sum_of_squares(toLevels(design.slip)), 0.9774, 5e-5);
  Values response(27);
  RandomStream stream(1, "any response");
  for (int i = 0; i < 200; ++i) {
    std::generate(response.begin(), response.end(), [&] { return stream.normal(); });
    EXPECT_LE(sum_of_squares(response), 1 + 1e-12);
  }
}

TEST(Correlation, OfRanksIgnoresMonotoneMaps) {
  RandomStream stream(2, "monotone");
  Values x(40), y(40), mapped(40);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = stream.normal(), y[i] = x[i] + stream.normal();
  std::transform(x.begin(), x.end(), mapped.begin(), [](double v) { return std::exp(3 * v) - 7; });
  EXPECT_EQ(*spearman(mapped, y), *spearman(x, y));
  EXPECT_EQ(*kendallTauB(mapped, y), *kendallTauB(x, y));
  EXPECT_GT(std::abs(*pearson(mapped, y) - *pearson(x, y)), 0.1) << "the map is no test: it changes nothing";
  std::transform(x.begin(), x.end(), mapped.begin(), [](double v) { return -v; });
  EXPECT_NEAR(*spearman(mapped, y), -*spearman(x, y), 1e-15);
  EXPECT_EQ(*kendallTauB(mapped, y), -*kendallTauB(x, y));
  EXPECT_EQ(*spearman(y, x), *spearman(x, y));
}

TEST(Correlation, IsUndefinedWhereItIs) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Values x{1, 2, 3, 4}, constant{0.1, 0.1, 0.1, 0.1}, shorter{1, 2}, broken{1, nan, 2, 3}, one{1}, none;
  for (const auto& coefficient : {pearson, spearman, kendallTauB}) {
    for (const Values* y : {&constant, &shorter, &broken}) EXPECT_FALSE(coefficient(x, *y));
    EXPECT_FALSE(coefficient(constant, x));
    EXPECT_FALSE(coefficient(one, one));
    EXPECT_FALSE(coefficient(none, none));
    EXPECT_EQ(*coefficient(shorter, shorter), 1);
  }
  EXPECT_FALSE(spearmanTest(shorter, shorter));
  EXPECT_FALSE(bonettWright(1.1, 20));
  EXPECT_FALSE(bonettWright(nan, 20));
  EXPECT_FALSE(bonettWright(0.5, 3));
  EXPECT_FALSE(bonettWright(0.5, 20, 1));
  EXPECT_FALSE(criticalCorrelation(2, 0.05));
  EXPECT_FALSE(criticalCorrelation(20, 0));
}

TEST(SpearmanTest, PerfectOrderIsAPoint) {
  const Values x{1, 2, 3, 4, 5};
  const SpearmanTest test = *spearmanTest(x, x);
  EXPECT_EQ(test.rho, 1);
  EXPECT_EQ(test.p, 0);
  EXPECT_TRUE(std::isinf(test.t));
  EXPECT_EQ(test.interval.low, 1);
  EXPECT_EQ(test.interval.high, 1);
}

TEST(SpearmanTest, CriticalValuesOfTheTable) {
  const std::vector<std::pair<std::size_t, std::array<double, 3>>> table{{27, {0.3809, 0.4869, 0.5974}},
                                                                         {54, {0.2681, 0.3477, 0.4354}},
                                                                         {81, {0.2185, 0.2847, 0.3589}},
                                                                         {162, {0.1543, 0.2019, 0.2562}}};
  for (const auto& [n, expected] : table) {
    std::size_t column = 0;
    for (const double alpha : {0.05, 0.01, 0.001}) {
      const double critical = *criticalCorrelation(n, alpha);
      EXPECT_NEAR(critical, expected[column++], 5e-5);
      EXPECT_NEAR(spearmanTest(critical, n)->p, alpha, 1e-12);  // and the inverse
    }
  }
}

// The three correlations of the grip study, n = 162, with the digits of the note.
TEST(SpearmanTest, OfTheGripStudy) {
  const auto expect = [](double rho, double t, double p, double p_unit, Interval interval) {
    const SpearmanTest test = *spearmanTest(rho, 162);
    EXPECT_NEAR(test.t, t, 5e-4);
    EXPECT_NEAR(test.p, p, 0.5 * p_unit);
    EXPECT_NEAR(test.interval.low, interval.low, 5e-4);
    EXPECT_NEAR(test.interval.high, interval.high, 5e-4);
  };
  expect(-0.346, -4.665, 6.5e-6, 1e-7, {-0.478, -0.198});
  expect(0.391, 5.374, 2.7e-7, 1e-8, {0.247, 0.518});
  expect(0.333, 4.467, 1.5e-5, 1e-6, {0.184, 0.467});
}

// Example of ci.spear in the R package statpsych.
TEST(SpearmanTest, AgreesWithStatpsych) {
  const Values y{21, 4, 9, 12, 35, 18, 10, 22, 24, 1, 6, 8, 13, 16, 19};
  const Values x{67, 28, 30, 28, 52, 40, 25, 37, 44, 10, 14, 20, 28, 40, 51};
  const SpearmanTest test = *spearmanTest(x, y);
  EXPECT_EQ(test.n, 15U);
  EXPECT_NEAR(test.rho, 0.8699639, 5e-8);
  EXPECT_NEAR(test.interval.low, 0.5840951, 5e-8);
  EXPECT_NEAR(test.interval.high, 0.9638297, 5e-8);
}

// Bivariate normal samples with Pearson correlation r have Spearman correlation 6/pi asin(r/2). Of 2000 intervals at 95
// % between 93.5 and 96.5 % cover it: three binomial standard deviations (0.49 % each); the formula is accurate to 0.5
// % here.
TEST(SpearmanTest, BonettWrightCoversAsOftenAsItSays) {
  constexpr int kRuns = 2000, kCases = 54;
  for (const double r : {0.0, 0.4, 0.7}) {
    const double truth = 6 / std::numbers::pi * std::asin(r / 2);
    int covered = 0;
    for (int run = 0; run < kRuns; ++run) {
      RandomStream stream(7, "bivariate", static_cast<std::uint64_t>(run));
      Values x(kCases), y(kCases);
      for (std::size_t i = 0; i < kCases; ++i) {
        x[i] = stream.normal(), y[i] = r * x[i] + std::sqrt(1 - r * r) * stream.normal();
      }
      covered += spearmanTest(x, y)->interval.contains(truth);
    }
    EXPECT_NEAR(covered / double{kRuns}, 0.95, 0.015 + 0.005) << "r = " << r;
  }
}

}  // namespace
}  // namespace presa::statistics
