#include "apps/studies/cost/forecast.h"

#include <gtest/gtest.h>

namespace presa::cost {
namespace {

using Kind = Forecast::Kind;

// Two settings, one ten times as long as the other: the forecast depends on durations, not on the number of runs.
TEST(Forecast, CountsSecondsNotRuns) {
  Forecast forecast(2);
  for (const std::uint64_t setting : {1, 2}) {
    forecast.add({Kind::kWatched, setting});
    for (int repeat = 0; repeat < 2; ++repeat) forecast.add({Kind::kTimed, setting});
  }
  EXPECT_LT(forecast.left(), 0) << "nothing is known";
  forecast.done({Kind::kWatched, 1}, 1);
  forecast.done({Kind::kWatched, 2}, 10);
  EXPECT_NEAR(forecast.left(), 2 * (1 + 10), 1e-12);
  forecast.done({Kind::kTimed, 1}, 0.5);
  EXPECT_NEAR(forecast.left(), 0.5 + 2 * 5, 1e-12) << "timed runs take half as long as watched ones";
  forecast.done({Kind::kTimed, 2}, 6);
  forecast.done({Kind::kTimed, 1}, 0.5);
  EXPECT_NEAR(forecast.left(), 6, 1e-12);
  forecast.done({Kind::kTimed, 2}, 6);
  EXPECT_EQ(forecast.left(), 0);
}

TEST(Forecast, WatchedRunsShareTheProcessors) {
  Forecast forecast(2);
  for (const std::uint64_t setting : {1, 2, 3}) forecast.add({Kind::kWatched, setting});
  forecast.done({Kind::kWatched, 1}, 4);
  EXPECT_NEAR(forecast.left(), 4, 1e-12) << "two of 4 s each, two at a time";
}

// A run that existed already takes no time and does not affect the forecast of others.
TEST(Forecast, ResumedRunsCountNothing) {
  Forecast forecast(1);
  forecast.add({Kind::kWatched, 1});
  forecast.add({Kind::kWatched, 2});
  forecast.done({Kind::kWatched, 1}, -1);
  EXPECT_LT(forecast.left(), 0);
}

}  // namespace
}  // namespace presa::cost
