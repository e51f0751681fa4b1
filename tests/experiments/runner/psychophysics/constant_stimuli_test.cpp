#include "experiments/runner/psychophysics/constant_stimuli.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

namespace presa::psychophysics {
namespace {

const ConstantStimuliPlan kSevenLevels{.levels = {-3, -2, -1, 0, 1, 2, 3}, .per_level = 20, .per_block = 2};

TEST(ConstantStimuli, EveryBlockHoldsEveryLevelEquallyOften) {
  ConstantStimuli method(kSevenLevels, RandomStream(1, "order"));
  while (!method.finished()) method.respond({.positive = true});
  const std::vector<Trial>& trials = method.trials();
  ASSERT_EQ(trials.size(), 140U);
  for (std::size_t block = 0; block < 10; ++block) {
    std::map<double, int> count;
    for (std::size_t i = 0; i < 14; ++i) ++count[trials[14 * block + i].stimulus.level];
    for (const double level : kSevenLevels.levels) EXPECT_EQ(count[level], 2) << "block " << block;
  }
}

// A discarded trial is repeated within its own block.
TEST(ConstantStimuli, DiscardedTrialsComeAgainWithinTheirBlock) {
  ConstantStimuli method(kSevenLevels, RandomStream(1, "order"));
  bool moved = false;
  while (!method.finished()) {
    if (method.next()->trial % 3 == 0) {
      const double discarded = method.next()->level;
      method.discard();
      moved = moved || method.next()->level != discarded;
    } else {
      method.respond({.positive = true});
    }
  }
  EXPECT_TRUE(moved) << "it went to a random place";
  std::vector<double> answered;
  for (const Trial& trial : method.trials()) {
    if (trial.response) answered.push_back(trial.stimulus.level);
  }
  ASSERT_EQ(answered.size(), 140U);
  for (std::size_t block = 0; block < 10; ++block) {
    const auto from = answered.begin() + static_cast<std::ptrdiff_t>(14 * block);
    const std::multiset<double> levels(from, from + 14);
    EXPECT_EQ(levels, (std::multiset<double>{-3, -3, -2, -2, -1, -1, 0, 0, 1, 1, 2, 2, 3, 3})) << "block " << block;
  }
}

TEST(ConstantStimuli, EveryMistakeIsNamed) {
  const ConstantStimuliPlan wrong{.levels = {1, 1, NAN}, .per_level = 0, .per_block = 0};
  EXPECT_EQ(mistakes(wrong).size(), 4U);
  EXPECT_THROW(ConstantStimuli(wrong, RandomStream(1, "order")), std::invalid_argument);
}

}  // namespace
}  // namespace presa::psychophysics
