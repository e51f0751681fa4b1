#include "experiments/runner/psychophysics/interleaved.h"

#include <gtest/gtest.h>

#include <array>

#include "experiments/runner/psychophysics/observer.h"
#include "tests/experiments/runner/psychophysics/binomial_range.h"

namespace presa::psychophysics {
namespace {

const StaircaseRule kRule{.start = 1, .steps_up = {0.1}, .down = 2, .stop_trials = 500};
const Observer kObserver({.location = 0.3, .spread = 0.2, .guess = 0.5}, Coding::kCorrect, 3);

// Bounds: the 99.99 % range of the binomial counts, for each staircase and for the catch trials.
TEST(Interleaved, StaircasesTakeTurnsAtRandomWithCatchTrialsAtTheirRate) {
  Interleaved method({.tracks = onBothSides(kRule, 2), .catch_rate = 0.1, .catch_level = 7},
                     RandomStream(5, "interleave"));
  while (method.trials().size() < 1000) method.respond(kObserver.answer(method));
  std::array<int, 5> count{};
  for (const Trial& trial : method.trials()) {
    ++count.at(trial.stimulus.track);
    EXPECT_EQ(trial.stimulus.kind == TrialKind::kCatch, trial.stimulus.track == 4);
    EXPECT_EQ(trial.stimulus.kind == TrialKind::kCatch, trial.stimulus.level == 7);
  }
  for (std::size_t track = 0; track < 5; ++track) {
    const BinomialRange range = binomialRange(1000, track < 4 ? 0.225 : 0.1, 0.9999);
    EXPECT_GE(count[track], range.low) << "track " << track;
    EXPECT_LE(count[track], range.high) << "track " << track;
  }
}

TEST(Interleaved, CatchTrialsMoveNoStaircase) {
  Interleaved method({.tracks = {kRule}, .catch_rate = 0.5}, RandomStream(5, "interleave"));
  for (int i = 0; i < 50; ++i) {
    const double level = method.tracks()[0].next()->level;
    const bool is_catch = method.next()->kind == TrialKind::kCatch;
    method.respond({.positive = false});
    EXPECT_EQ(method.tracks()[0].next()->level == level, is_catch);
  }
}

TEST(Interleaved, EachStaircaseRunsToItsOwnEndOnItsOwnSide) {
  StaircaseRule rule = kRule;
  rule.stop_reversals = 8;
  rule.min = 0.05;
  Interleaved method({.tracks = onBothSides(rule, 3)}, RandomStream(5, "interleave"));
  while (!method.finished()) method.respond(kObserver.answer(method));
  for (const Trial& trial : method.trials()) EXPECT_EQ(trial.stimulus.level > 0, trial.stimulus.track < 3);
  double sum = 0;
  for (const Staircase& track : method.tracks()) {
    EXPECT_EQ(track.reversals().size(), 8U);
    sum += track.threshold(6).value();
  }
  EXPECT_DOUBLE_EQ(method.threshold(6).value(), sum / 6);
  EXPECT_EQ(method.threshold(9), std::nullopt);
}

TEST(Interleaved, EveryMistakeIsNamed) {
  const InterleavedPlan wrong{.tracks = {kRule, {.start = 1}}, .catch_rate = 1};
  EXPECT_EQ(mistakes(wrong).size(), 3U) << "catch rate, missing steps, missing trials of the second staircase";
  EXPECT_EQ(mistakes(InterleavedPlan{}).size(), 1U);
}

}  // namespace
}  // namespace presa::psychophysics
