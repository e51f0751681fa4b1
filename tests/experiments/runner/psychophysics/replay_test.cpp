// An interrupted session continues from its log: each method, stopped after any trial and rebuilt by replaying the log
// so far, must present the rest of the session bit-identically.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <stdexcept>

#include "experiments/runner/psychophysics/adjustment.h"
#include "experiments/runner/psychophysics/constant_stimuli.h"
#include "experiments/runner/psychophysics/forced_choice.h"
#include "experiments/runner/psychophysics/interleaved.h"
#include "experiments/runner/psychophysics/observer.h"
#include "experiments/runner/psychophysics/quest_plus.h"

namespace presa::psychophysics {
namespace {

using Factory = std::function<std::unique_ptr<Method>(std::uint64_t seed)>;
struct Case {
  const char* name;
  Factory make;
};

const StaircaseRule kRule{
    .start = 0.8, .steps_up = {0.2, 0.1}, .change_after = 2, .down = 2, .stop_reversals = 6, .stop_trials = 40};

std::unique_ptr<Method> staircase(std::uint64_t) { return std::make_unique<Staircase>(kRule); }
std::unique_ptr<Method> interleaved(std::uint64_t seed) {
  return std::make_unique<Interleaved>(
      InterleavedPlan{.tracks = onBothSides(kRule, 2), .catch_rate = 0.1, .catch_level = 1},
      RandomStream(seed, "interleave"));
}
std::unique_ptr<Method> constantStimuli(std::uint64_t seed) {
  return std::make_unique<ConstantStimuli>(
      ConstantStimuliPlan{.levels = {-0.2, -0.1, 0, 0.1, 0.2}, .per_level = 8, .per_block = 2},
      RandomStream(seed, "order"));
}
std::unique_ptr<Method> questPlus(std::uint64_t) {
  return std::make_unique<QuestPlus>(QuestPlusPlan{
      .grid = {.threshold = {{0.1, 0.2, 0.3, 0.4, 0.5}}, .spread = {{0.05, 0.1, 0.2}}, .lapse = {{0.0, 0.04}}},
      .levels = {0.05, 0.1, 0.2, 0.3, 0.4, 0.6},
      .stop_trials = 40});
}
std::unique_ptr<Method> adjustment(std::uint64_t seed) {
  return std::make_unique<Adjustment>(
      AdjustmentPlan{.nearest = 0.1, .farthest = 0.5, .trials = 21, .coarse = 0.1, .fine = 0.01},
      RandomStream(seed, "starts"));
}
Factory asForcedChoice(const Factory& inner) {
  return [inner](std::uint64_t seed) {
    return std::make_unique<ForcedChoice>(inner(seed), ForcedChoicePlan{}, RandomStream(seed, "places"));
  };
}

constexpr std::uint64_t kSeed = 41;
const Observer kObserver({.location = 0.3, .spread = 0.15, .guess = 0.5, .lapse = 0.02}, Coding::kCorrect, kSeed);

/// One trial; every seventh presentation is discarded.
void step(Method& method) {
  if (method.next()->trial % 7 == 3) return method.discard();
  method.respond(kObserver.answer(method));
}

class Replay : public testing::TestWithParam<Case> {};

TEST_P(Replay, KilledAfterAnyTrialTheSessionGoesOnToTheBit) {
  const std::unique_ptr<Method> unbroken = GetParam().make(kSeed);
  while (!unbroken->finished()) step(*unbroken);
  const std::vector<Trial>& log = unbroken->trials();
  ASSERT_GT(log.size(), 20U);
  for (std::size_t killed = 0; killed <= log.size(); ++killed) {
    const std::unique_ptr<Method> resumed = GetParam().make(kSeed);
    replay(*resumed, std::span(log).first(killed));
    while (!resumed->finished()) step(*resumed);
    ASSERT_EQ(resumed->trials(), log) << "killed after trial " << killed;
  }
}

// A log of another definition must be rejected: its answers belong to other stimuli.
TEST_P(Replay, ALogOfSomethingElseIsRefused) {
  const std::unique_ptr<Method> method = GetParam().make(kSeed);
  for (int i = 0; i < 10; ++i) step(*method);
  std::vector<Trial> log = method->trials();
  log[9].stimulus.level += 1e-12;
  EXPECT_THROW(replay(*GetParam().make(kSeed), log), std::runtime_error);
}

TEST_P(Replay, AskingAgainChangesNothing) {
  const std::unique_ptr<Method> method = GetParam().make(kSeed);
  step(*method);
  const std::optional<Stimulus> first = method->next();
  EXPECT_EQ(method->next(), first);
}

INSTANTIATE_TEST_SUITE_P(Methods, Replay,
                         testing::Values(Case{"Staircase", staircase}, Case{"Interleaved", interleaved},
                                         Case{"ConstantStimuli", constantStimuli}, Case{"QuestPlus", questPlus},
                                         Case{"Adjustment", adjustment},
                                         Case{"StaircaseIn2IFC", asForcedChoice(staircase)},
                                         Case{"InterleavedIn2IFC", asForcedChoice(interleaved)},
                                         Case{"ConstantStimuliIn2IFC", asForcedChoice(constantStimuli)},
                                         Case{"QuestPlusIn2IFC", asForcedChoice(questPlus)}),
                         [](const auto& instance) { return instance.param.name; });

class Seeded : public testing::TestWithParam<Case> {};

// Two participants must not get the same order.
TEST_P(Seeded, AnotherSeedPresentsOtherTrials) {
  const auto session = [&](std::uint64_t seed) {
    const std::unique_ptr<Method> method = GetParam().make(seed);
    while (!method->finished()) step(*method);
    return method->trials();
  };
  EXPECT_EQ(session(1), session(1));
  EXPECT_NE(session(1), session(2));
}

INSTANTIATE_TEST_SUITE_P(Methods, Seeded,
                         testing::Values(Case{"Interleaved", interleaved}, Case{"ConstantStimuli", constantStimuli},
                                         Case{"Adjustment", adjustment},
                                         Case{"StaircaseIn2IFC", asForcedChoice(staircase)}),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace presa::psychophysics
