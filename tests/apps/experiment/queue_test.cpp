#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/runner/definition/queue.h"

namespace presa::experiment {
namespace {

using testing::ElementsAre;

std::vector<PlannedTrial> planned() {
  std::vector<PlannedTrial> trials;
  for (int i = 1; i <= 4; ++i) {
    PlannedTrial trial;
    trial.number = i;
    trial.block = i <= 2 ? 1 : 2;
    trial.seed = static_cast<std::uint64_t>(i);
    trials.push_back(trial);
  }
  return trials;
}

std::vector<int> numbers(const TrialQueue& queue) {
  std::vector<int> all;
  for (const PlannedTrial& trial : queue.waiting()) all.push_back(trial.number);
  return all;
}

TEST(TrialQueue, AbortedTrialsComeAtTheEndOfTheirBlock) {
  TrialQueue queue(planned(), {3, Retry::Place::kEndOfBlock});
  queue.finish(Outcome::kAborted);
  EXPECT_THAT(numbers(queue), ElementsAre(2, 1, 3, 4));
  queue.finish(Outcome::kDone);
  EXPECT_EQ(queue.next()->attempt, 2);
  EXPECT_NE(queue.next()->seed, 1U);  // otherwise a simulated subject would repeat its behaviour
}

TEST(TrialQueue, OrAtOnce) {
  TrialQueue queue(planned(), {3, Retry::Place::kNext});
  queue.finish(Outcome::kAborted);
  EXPECT_THAT(numbers(queue), ElementsAre(1, 2, 3, 4));
}

TEST(TrialQueue, AttemptsAreLimited) {
  TrialQueue queue(planned(), {2, Retry::Place::kNext});
  queue.finish(Outcome::kAborted);
  queue.finish(Outcome::kAborted);
  EXPECT_THAT(numbers(queue), ElementsAre(2, 3, 4));
  EXPECT_EQ(queue.missing(), 1U);
}

// An external interruption does not count against a trial: same place, same seed, no attempt used up.
TEST(TrialQueue, InterruptedTrialsComeNextAsTheyWere) {
  TrialQueue queue(planned(), {1, Retry::Place::kEndOfBlock});
  for (int i = 0; i < 5; ++i) queue.finish(Outcome::kInterrupted);
  EXPECT_THAT(numbers(queue), ElementsAre(1, 2, 3, 4));
  EXPECT_EQ(queue.next()->attempt, 1);
  EXPECT_EQ(queue.next()->seed, 1U);
  EXPECT_EQ(queue.missing(), 0U);
}

TEST(TrialQueue, SkippedTrialsAreMissing) {
  TrialQueue queue(planned(), {3, Retry::Place::kEndOfBlock});
  queue.finish(Outcome::kSkipped);
  for (int i = 0; i < 3; ++i) queue.finish(Outcome::kDone);
  EXPECT_EQ(queue.next(), nullptr);
  EXPECT_EQ(queue.done(), 3U);
  EXPECT_EQ(queue.missing(), 1U);
}

}  // namespace
}  // namespace presa::experiment
