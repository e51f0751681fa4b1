#include "experiments/runner/statistics/ranks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "framework/core/math/random.h"
#include "tests/experiments/runner/statistics/grip_design.h"

namespace presa::statistics {
namespace {

using Values = std::vector<double>;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(MidRanks, TiesShareTheirPlaces) {
  EXPECT_EQ(midRanks(Values{}), Values{});
  EXPECT_EQ(midRanks(Values{7}), Values{1});
  EXPECT_EQ(midRanks(Values{3, 1, 3, 2}), (Values{3.5, 1, 3.5, 2}));
  EXPECT_EQ(midRanks(Values{5, 5, 5, 5}), (Values{2.5, 2.5, 2.5, 2.5}));
  EXPECT_EQ(midRanks(Values{kInfinity, -kInfinity, 0, -0.0}), (Values{4, 1, 2.5, 2.5}));
}

TEST(MidRanks, NanTakesUpNoPlace) {
  const Values ranks = midRanks(Values{2, kNan, 1});
  EXPECT_EQ(ranks[0], 2);
  EXPECT_TRUE(std::isnan(ranks[1]));
  EXPECT_EQ(ranks[2], 1);
}

// The sum is exact: halves below 2^53 are exact in binary.
TEST(MidRanks, SumIsThatOfAllPlacesWhateverTheTies) {
  for (std::size_t n = 1; n < 60; ++n) {
    RandomStream stream(5, "ties", n);
    Values values(n);
    for (double& value : values) value = static_cast<double>(stream.below(1 + n / 2));
    const Values ranks = midRanks(values);
    EXPECT_EQ(std::accumulate(ranks.begin(), ranks.end(), 0.0), 0.5 * static_cast<double>(n * (n + 1)));
  }
}

TEST(ToLevels, FindsTheSevenSlipForces) {
  const GripDesign design;
  Values forces = design.slip;
  for (const double force : design.slip) forces.push_back(std::nextafter(force, kInfinity));  // last-bit differences
  const Values levels = toLevels(forces);
  const Values expected{0.40875, 0.613125, 0.8175, 1.22625, 1.635, 2.4525, 4.905};
  const std::set<double> found(levels.begin(), levels.end());
  ASSERT_EQ(found.size(), expected.size());
  std::size_t i = 0;
  for (const double level : found) EXPECT_NEAR(level, expected[i++], 1e-12);
}

TEST(ToLevels, KeepsWhatReallyDiffers) {
  EXPECT_EQ(toLevels(Values{1 + 2e-9, 1, 1 + 0.5e-9}), (Values{1 + 2e-9, 1, 1}));
  EXPECT_EQ(toLevels(Values{-1, -1 - 1e-12, 0, 1e-300}), (Values{-1 - 1e-12, -1 - 1e-12, 0, 1e-300}));
  EXPECT_EQ(toLevels(Values{1, kInfinity, kInfinity, -kInfinity}), (Values{1, kInfinity, kInfinity, -kInfinity}));
  EXPECT_TRUE(std::isnan(toLevels(Values{kNan, 1})[0]));
}

}  // namespace
}  // namespace presa::statistics
