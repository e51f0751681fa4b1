#include "experiments/runner/psychophysics/forced_choice.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <memory>
#include <stdexcept>

#include "experiments/runner/psychophysics/constant_stimuli.h"
#include "tests/experiments/runner/psychophysics/binomial_range.h"

namespace presa::psychophysics {
namespace {

const ConstantStimuliPlan kSevenLevels{.levels = {-3, -2, -1, 0, 1, 2, 3}, .per_level = 20, .per_block = 2};

std::unique_ptr<Method> sevenLevels() {
  return std::make_unique<ConstantStimuli>(kSevenLevels, RandomStream(1, "order"));
}

// A preference for one interval must not look like a difference between the stimuli.
TEST(ForcedChoice, TheStandardIsInEachPlaceEquallyOftenAtEachLevel) {
  ForcedChoice task(sevenLevels(), {.balance_over = 20}, RandomStream(1, "places"));
  int presented = 0, alternations = 0, last = 0;
  std::map<double, std::array<int, 3>> count;
  while (!task.finished()) {
    if (++presented % 5 == 0) {
      task.discard();  // the balance refers to answered trials
      continue;
    }
    const Stimulus stimulus = *task.next();
    ++count[stimulus.level].at(static_cast<std::size_t>(stimulus.standard_place));
    alternations += stimulus.standard_place != last;
    last = stimulus.standard_place;
    task.respond({.chosen = 1});
  }
  ASSERT_EQ(count.size(), 7U);
  for (const auto& [level, places] : count) EXPECT_EQ(places, (std::array<int, 3>{0, 10, 10})) << "level " << level;
  const BinomialRange range = binomialRange(139, 0.5, 0.9999);  // neither strict alternation nor one long run
  EXPECT_GE(alternations, range.low);
  EXPECT_LE(alternations, range.high);
}

/// Coding of each answer to one trial: whether choosing the standard or the comparison counts as positive.
struct Coded {
  bool standard = false, comparison = false;
};
Coded codedAt(double level, const ForcedChoicePlan& plan) {
  Coded coded;
  for (const bool chooses_comparison : {false, true}) {
    ForcedChoice task(std::make_unique<ConstantStimuli>(ConstantStimuliPlan{.levels = {level}, .per_level = 1},
                                                        RandomStream(1, "order")),
                      plan, RandomStream(1, "places"));
    const int standard =
        plan.task == Task::kYesNo ? 2 : task.next()->standard_place;  // "no" takes the role of the standard
    task.respond({.chosen = chooses_comparison ? 3 - standard : standard});
    (chooses_comparison ? coded.comparison : coded.standard) = task.trials().back().response->positive;
  }
  return coded;
}

TEST(ForcedChoice, CorrectAndGreaterAreWorkedOutFromThePlaceChosen) {
  const auto expect = [](double level, const ForcedChoicePlan& plan, bool comparison_is_positive) {
    const Coded coded = codedAt(level, plan);
    EXPECT_EQ(coded.comparison, comparison_is_positive) << "level " << level;
    EXPECT_EQ(coded.standard, !comparison_is_positive) << "level " << level;
  };
  using enum Coding;
  for (const Task task : {Task::kTwoIntervals, Task::kTwoAlternatives}) {
    expect(1, {.task = task, .coding = kCorrect}, true);
    expect(-1, {.task = task, .coding = kCorrect}, false);
    expect(1, {.task = task, .coding = kCorrect, .asks_for_less = true}, false);
    expect(-1, {.task = task, .coding = kCorrect, .asks_for_less = true}, true);
    for (const double level : {-1.0, 0.0, 1.0}) {
      expect(level, {.task = task, .coding = kGreater}, true);
      expect(level, {.task = task, .coding = kGreater, .asks_for_less = true}, false);
    }
  }
  expect(1, {.task = Task::kYesNo, .coding = kCorrect}, true);
  expect(-1, {.task = Task::kYesNo, .coding = kCorrect}, true);
  expect(0, {.task = Task::kYesNo, .coding = kCorrect}, false);
  expect(-1, {.task = Task::kYesNo, .coding = kGreater}, true);
}

TEST(ForcedChoice, ASimulatedAnswerIsCodedAsItWasMeant) {
  ForcedChoice task(sevenLevels(), {.asks_for_less = true}, RandomStream(1, "places"));
  for (int i = 0; !task.finished(); ++i) {
    task.respond(task.responseFor(i % 3 == 0));
    EXPECT_EQ(task.trials().back().response->positive, i % 3 == 0);
  }
}

TEST(ForcedChoice, ThereIsNoThirdPlace) {
  ForcedChoice task(sevenLevels(), {}, RandomStream(1, "places"));
  EXPECT_THROW(task.respond({.chosen = 0}), std::invalid_argument);
  EXPECT_THROW(task.respond({.chosen = 3}), std::invalid_argument);
  EXPECT_TRUE(task.trials().empty());
  EXPECT_THROW(ForcedChoice(nullptr, {}, RandomStream(1, "places")), std::invalid_argument);
  EXPECT_THROW(ForcedChoice(sevenLevels(), {.task = Task::kAdjust}, RandomStream(1, "places")), std::invalid_argument);
  EXPECT_THROW(ForcedChoice(sevenLevels(), {.balance_over = 0}, RandomStream(1, "places")), std::invalid_argument);
}

}  // namespace
}  // namespace presa::psychophysics
