#include "experiments/runner/statistics/means.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "experiments/runner/statistics/margin.h"
#include "framework/core/math/random.h"

namespace presa::statistics {
namespace {

using Values = std::vector<double>;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Means, MeanAndDeviationKeepTheirDigitsFarFromZero) {
  const Values near{1, 2, 3, 4}, far{1e12 + 1, 1e12 + 2, 1e12 + 3, 1e12 + 4};
  EXPECT_EQ(*mean(near), 2.5);
  EXPECT_EQ(*mean(far), 1e12 + 2.5);
  EXPECT_NEAR(*standardDeviation(near), std::sqrt(5.0 / 3), 1e-15);
  EXPECT_NEAR(*standardDeviation(far), std::sqrt(5.0 / 3), 1e-12);
  EXPECT_EQ(*standardDeviation(Values{0.1, 0.1, 0.1}), 0);
}

// Type 7 by its definition h = (n - 1) p; R prints the same quartiles for these values.
TEST(Means, QuantilesAreOfTypeSeven) {
  const Values values{10, 1, 4, 2};
  EXPECT_EQ(*quantile(values, 0), 1);
  EXPECT_EQ(*quantile(values, 1), 10);
  EXPECT_EQ(*quantile(values, 0.25), 1.75);
  EXPECT_EQ(*quantile(values, 0.75), 5.5);
  EXPECT_EQ(*median(values), 3);
  EXPECT_EQ(*median(Values{5, 3, 9}), 5);
  EXPECT_EQ(*quantile(Values{5}, 0.3), 5);
}

// Half-widths of the 95 % interval in units of s; the last digit given is the tolerance.
TEST(Means, IntervalsOfTheGripStudy) {
  const auto half_width = [](std::size_t n) {
    Values values(n);
    for (std::size_t i = 0; i < n; ++i) values[i] = static_cast<double>(i * i);
    const MeanEstimate estimate = *meanInterval(values);
    EXPECT_EQ(estimate.n, n);
    EXPECT_NEAR(0.5 * (estimate.interval.low + estimate.interval.high), estimate.mean, 1e-9);
    return estimate.interval.halfWidth() / estimate.sd;
  };
  EXPECT_NEAR(half_width(6), 1.0494, 5e-5);
  EXPECT_NEAR(half_width(18), 0.4973, 5e-5);
  EXPECT_NEAR(half_width(2), 8.985, 5e-4);
  EXPECT_NEAR(half_width(3), 2.484, 5e-4);
  EXPECT_NEAR(half_width(54), 0.2729, 5e-5);
}

// 5000 samples of size six: three binomial standard deviations of 95 % are 0.92 %.
TEST(Means, IntervalCoversAsOftenAsItSays) {
  int covered = 0;
  for (int run = 0; run < 5000; ++run) {
    RandomStream stream(3, "mean", static_cast<std::uint64_t>(run));
    Values values(6);
    for (double& value : values) value = 2 + 0.3 * stream.normal();
    covered += meanInterval(values)->interval.contains(2);
  }
  EXPECT_NEAR(covered / 5000.0, 0.95, 0.0093);
}

TEST(Means, NoResultWhereThereIsNone) {
  EXPECT_FALSE(mean(Values{}));
  EXPECT_FALSE(mean(Values{1, kNan}));
  EXPECT_FALSE(standardDeviation(Values{1}));
  EXPECT_FALSE(quantile(Values{}, 0.5));
  EXPECT_FALSE(quantile(Values{1, 2}, 1.1));
  EXPECT_FALSE(quantile(Values{1, 2}, kNan));
  EXPECT_FALSE(median(Values{kNan}));
  EXPECT_FALSE(meanInterval(Values{1}));
  EXPECT_FALSE(meanInterval(Values{1, 2}, 0));
}

// Two subjects, two conditions: the subjects' means are 3 and 10, the grand mean 6.5, so the centred cells are 5.5, 7.5
// and 4.5, 8.5; sd sqrt(1/2) per condition, times Morey's sqrt 2, and t(.975, 1) = 12.7062 over sqrt 2.
TEST(WithinSubject, ByHand) {
  const std::vector<LabelledValue> values{{1, 0, 1}, {1, 0, 3}, {1, 1, 4}, {2, 0, 8}, {2, 1, 12}};
  const WithinSubjectIntervals result = *withinSubjectIntervals(values);
  EXPECT_EQ(result.subjects, 2U);
  EXPECT_EQ(result.correction, std::sqrt(2.0));
  ASSERT_EQ(result.conditions.size(), 2U);
  EXPECT_NEAR(result.conditions[0].mean, 5, 1e-12);
  EXPECT_NEAR(result.conditions[1].mean, 8, 1e-12);
  const double sd = std::sqrt(0.5);
  for (const auto& condition : result.conditions) {
    EXPECT_NEAR(condition.interval.halfWidth(), 12.706204736174698 * std::sqrt(2.0) * sd / std::sqrt(2.0), 1e-9);
  }
}

TEST(WithinSubject, IgnoresWhatSubjectsAddToAll) {
  std::vector<LabelledValue> values, shifted;
  RandomStream stream(4, "within");
  for (int subject = 0; subject < 5; ++subject) {
    for (int condition = 0; condition < 3; ++condition) {
      const double value = condition + stream.normal();
      values.push_back({subject, condition, value});
      shifted.push_back({subject, condition, value + 10 * subject - 20});
    }
  }
  const auto plain = *withinSubjectIntervals(values), moved = *withinSubjectIntervals(shifted);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(plain.conditions[i].mean, moved.conditions[i].mean, 1e-12);
    EXPECT_NEAR(plain.conditions[i].interval.low, moved.conditions[i].interval.low, 1e-12);
  }
  EXPECT_NEAR(plain.correction, std::sqrt(1.5), 1e-15);
}

TEST(WithinSubject, NeedsEverySubjectInEveryCondition) {
  EXPECT_FALSE(withinSubjectIntervals(std::vector<LabelledValue>{}));
  EXPECT_FALSE(withinSubjectIntervals(std::vector<LabelledValue>{{1, 0, 1}, {1, 1, 2}}));
  EXPECT_FALSE(withinSubjectIntervals(std::vector<LabelledValue>{{1, 0, 1}, {2, 0, 2}}));
  EXPECT_FALSE(withinSubjectIntervals(std::vector<LabelledValue>{{1, 0, 1}, {1, 1, 2}, {2, 0, 2}}));
  EXPECT_FALSE(withinSubjectIntervals(std::vector<LabelledValue>{{1, 0, 1}, {1, 1, kNan}, {2, 0, 2}, {2, 1, 2}}));
}

TEST(Margin, SlipForcesOfTheTable) {
  const std::vector<std::pair<double, Values>> table{
      {0.4, {1.226250, 2.452500, 4.905000}}, {0.8, {0.613125, 1.226250, 2.452500}},
      {1.2, {0.408750, 0.817500, 1.635000}}, {0.3, {1.635000, 3.270000, 6.540000}},
      {0.6, {0.817500, 1.635000, 3.270000}}, {1.1, {0.445909, 0.891818, 1.783636}}};
  for (const auto& [mu, forces] : table) {
    std::size_t i = 0;
    for (const double mass : {0.1, 0.2, 0.4}) EXPECT_NEAR(*slipForce(mass, mu), forces[i++], 5e-7);
  }
  EXPECT_NEAR(*slipForce(0.4, 0.3) / *slipForce(0.4, 0.4), 4.0 / 3, 1e-12);  // to stick again: a third more
  EXPECT_NEAR(*slipForce(0.4, 0.4) / 500, 9.81e-3, 1e-12);                   // deepest squeeze at slip
  EXPECT_NEAR(*slipForce(0.1, 1.2) / 2000, 0.204375e-3, 1e-12);              // shallowest
}

TEST(Margin, LimitsOfBothConventions) {
  const double slip = 1.635;
  EXPECT_EQ(*relativeSafetyMargin(slip, slip), 0);
  EXPECT_EQ(*marginOverSlipForce(slip, slip), 0);
  EXPECT_NEAR(*relativeSafetyMargin(2 * slip, slip), 50, 1e-12);
  EXPECT_NEAR(*marginOverSlipForce(2 * slip, slip), 100, 1e-12);
  for (const double sm : {0.1, 0.25, 0.4}) EXPECT_NEAR(*relativeSafetyMargin(slip / (1 - sm), slip), 100 * sm, 1e-12);
  EXPECT_LT(*relativeSafetyMargin(0.9 * slip, slip), 0);
  EXPECT_LE(*relativeSafetyMargin(1e9, slip), 100);
  EXPECT_EQ(*relativeSafetyMargin(1, 0), 100);
  EXPECT_FALSE(marginOverSlipForce(1, 0));
  EXPECT_FALSE(relativeSafetyMargin(0, slip));
  EXPECT_FALSE(relativeSafetyMargin(kNan, slip));
  EXPECT_FALSE(relativeSafetyMargin(1, -1));
  EXPECT_FALSE(slipForce(0.1, 0));
  EXPECT_FALSE(slipForce(kNan, 0.4));
}

}  // namespace
}  // namespace presa::statistics
