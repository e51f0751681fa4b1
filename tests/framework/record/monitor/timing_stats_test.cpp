#include "framework/core/schedule/timing_stats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace presa {
namespace {

// 32 geometric buckets per octave: a value lies at most 2^(1/32) - 1 below the upper edge of its bucket
const double kBucketWidth = std::exp2(1.0 / 32) - 1;

std::int64_t exactPercentile(std::vector<std::int64_t> values, double q) {
  std::sort(values.begin(), values.end());
  const auto rank =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(q * static_cast<double>(values.size()))));
  return values[rank - 1];
}

// A percentile that is too low would hide a deadline miss: it may be one bucket too high, never too low.
TEST(DurationHistogram, PercentilesAreNeverTooLowAndAtMostOneBucketTooHigh) {
  std::mt19937_64 random(7);
  for (const double octaves : {2.0, 12.0, 30.0}) {
    DurationHistogram histogram;
    std::vector<std::int64_t> values;
    for (int i = 0; i < 20'000; ++i) {
      const double u = static_cast<double>(random()) / static_cast<double>(std::mt19937_64::max());
      values.push_back(static_cast<std::int64_t>(std::exp2(octaves * u) * 100));
      histogram.add(values.back());
    }
    for (const double q : {0.001, 0.1, 0.5, 0.9, 0.99, 0.999, 1.0}) {
      const std::int64_t exact = exactPercentile(values, q);
      EXPECT_GE(histogram.percentile(q), exact) << octaves << " octaves, q = " << q;
      EXPECT_LE(static_cast<double>(histogram.percentile(q)), static_cast<double>(exact) * (1 + kBucketWidth))
          << octaves << " octaves, q = " << q;
    }
  }
}

// Powers of two and their neighbours lie on bucket borders, where an index is easily off by one.
TEST(DurationHistogram, EachDurationAloneIsFoundExactlyBecauseTheMaximumBoundsItsBucket) {
  for (int octave = 0; octave < 62; ++octave) {
    for (const std::int64_t offset : {-1, 0, 1}) {
      const std::int64_t value = (std::int64_t{1} << octave) + offset;
      DurationHistogram histogram;
      histogram.add(value);
      EXPECT_EQ(histogram.percentile(0.5), value);
    }
  }
}

// As above with a larger maximum present, so that the bucket's own edge is returned.
TEST(DurationHistogram, BucketsOnOctaveBordersKeepTheirWidth) {
  for (int octave = 0; octave < 60; ++octave) {
    for (const std::int64_t offset : {-1, 0, 1}) {
      const std::int64_t value = (std::int64_t{1} << octave) + offset;
      DurationHistogram histogram;
      histogram.add(value);
      histogram.add(std::int64_t{1} << 61);
      const std::int64_t read = histogram.percentile(0.5);
      EXPECT_GE(read, value);
      EXPECT_LE(static_cast<double>(read - value), static_cast<double>(value) * kBucketWidth) << value;
    }
  }
}

// Mean and maximum are exact, because they do not use buckets. A clock that steps back counts as zero.
TEST(DurationHistogram, MeanAndMaximumAreExactAndNegativeDurationsCountAsZero) {
  DurationHistogram histogram;
  EXPECT_EQ(histogram.percentile(0.5), 0);
  EXPECT_EQ(histogram.mean(), 0);
  for (const std::int64_t value : {-50, 1'000, 2'001, 3'003}) histogram.add(value);
  EXPECT_EQ(histogram.count(), 4u);
  EXPECT_EQ(histogram.max(), 3'003);
  EXPECT_EQ(histogram.mean(), (0 + 1'000 + 2'001 + 3'003) / 4.0);
  EXPECT_EQ(histogram.percentile(0.25), 0);
}

}  // namespace
}  // namespace presa
