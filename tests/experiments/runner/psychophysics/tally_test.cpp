#include "experiments/runner/psychophysics/tally.h"

#include <gtest/gtest.h>

namespace presa::psychophysics {
namespace {

// The tally counts every answered trial once, by ascending level.
TEST(Tally, CountsAnswersByLevelAndLeavesOutTheRest) {
  const auto trial = [](double level, TrialKind kind, std::optional<bool> positive) {
    Trial made{.stimulus = {.level = level, .kind = kind}, .response = std::nullopt};
    if (positive) made.response = Response{.positive = *positive};
    return made;
  };
  using enum TrialKind;
  const std::vector<Trial> trials{trial(2, kTest, true),        trial(-1, kTest, false), trial(1, kTest, true),
                                  trial(2, kTest, false),       trial(9, kCatch, true),  trial(9, kCatch, false),
                                  trial(2, kTest, std::nullopt)};
  EXPECT_EQ(tally(trials, Coding::kGreater),
            (std::vector<statistics::StimulusLevel>{{-1, 1, 0}, {1, 1, 1}, {2, 2, 1}}));
  EXPECT_EQ(tally(trials, Coding::kCorrect), (std::vector<statistics::StimulusLevel>{{1, 2, 1}, {2, 2, 1}}));
  EXPECT_EQ(tallyCatch(trials), (statistics::StimulusLevel{0, 2, 1}));
}

}  // namespace
}  // namespace presa::psychophysics
