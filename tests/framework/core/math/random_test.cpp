#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "framework/core/math/random.h"

namespace presa {
namespace {

// Golden values: a study must give the same order on every machine and in every later version.
TEST(RandomStream, FirstNumbersAreFixedForEver) {
  RandomStream stream(20061, "order");
  std::vector<std::uint64_t> drawn;
  for (int i = 0; i < 10; ++i) drawn.push_back(stream.bits() >> 32);
  const std::vector<std::uint64_t> expected{2206330977, 296899986, 946057609,  3403264302, 480078572,
                                            1317034381, 640424760, 1277865063, 3852076559, 1490513844};
  EXPECT_EQ(drawn, expected);
}

// The standard's own check value: a default-seeded mt19937_64 gives this as its 10000th number.
TEST(RandomStream, EngineIsTheStandardOne) {
  std::mt19937_64 engine;
  engine.discard(9999);
  EXPECT_EQ(engine(), 9981545732273789042U);
}

TEST(RandomStream, NameAndItemSeparateStreams) {
  EXPECT_NE(RandomStream(1, "order").bits(), RandomStream(1, "noise").bits());
  EXPECT_NE(RandomStream(1, "order").bits(), RandomStream(2, "order").bits());
  EXPECT_NE(RandomStream(1, "order", 1).bits(), RandomStream(1, "order", 2).bits());
  EXPECT_EQ(RandomStream(1, "order", 1).bits(), RandomStream(1, "order", 1).bits());
}

// Bounds: five standard errors of each moment, n = 200 000.
TEST(RandomStream, NormalHasItsMoments) {
  constexpr int n = 200000;
  RandomStream stream(3, "normal");
  double s1 = 0, s2 = 0, s3 = 0, s4 = 0;
  for (int i = 0; i < n; ++i) {
    const double x = stream.normal();
    s1 += x, s2 += x * x, s3 += x * x * x, s4 += x * x * x * x;
  }
  EXPECT_NEAR(s1 / n, 0, 5 * std::sqrt(1.0 / n));
  EXPECT_NEAR(s2 / n, 1, 5 * std::sqrt(2.0 / n));
  EXPECT_NEAR(s3 / n, 0, 5 * std::sqrt(15.0 / n));
  EXPECT_NEAR(s4 / n, 3, 5 * std::sqrt(96.0 / n));
}

// Chi-square over the six orders of three items, 5 degrees of freedom: 20.5 is its 99.9 % point.
TEST(RandomStream, ShuffleGivesEveryOrderAlike) {
  constexpr int n = 60000;
  RandomStream stream(4, "shuffle");
  std::array<int, 27> count{};
  for (int i = 0; i < n; ++i) {
    std::array<int, 3> items{0, 1, 2};
    stream.shuffle(std::span<int>(items));
    ++count[static_cast<std::size_t>(9 * items[0] + 3 * items[1] + items[2])];
  }
  double chi2 = 0;
  int orders = 0;
  for (const int c : count) {
    if (c == 0) continue;
    ++orders;
    chi2 += std::pow(c - n / 6.0, 2) / (n / 6.0);
  }
  EXPECT_EQ(orders, 6);
  EXPECT_LT(chi2, 20.5);
}

TEST(RandomStream, BelowStaysBelow) {
  RandomStream stream(5, "below");
  std::array<int, 7> count{};
  for (int i = 0; i < 7000; ++i) ++count.at(stream.below(7));
  EXPECT_GT(*std::min_element(count.begin(), count.end()), 850);
}

}  // namespace
}  // namespace presa
