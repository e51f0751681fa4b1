#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/core/math/random.h"
#include "tests/support/method_run.h"

namespace presa::psychophysics {
namespace {

using test::MethodRun;
using testing::DoubleNear;
using testing::ElementsAre;

constexpr double kRounding = 1e-12;

// target 0.75: the step down is a third of the step up
TEST(WeightedUpDown, StepsDownByAThirdOfTheStepUpForThreeQuarters) {
  MethodRun run("weighted_up_down", {{"start", "1"}, {"step", "0.3"}, {"trials", "4"}});
  int answers = 0;
  run.answer([&](double) { return answers++ != 1; });
  EXPECT_THAT(run.levels(), ElementsAre(DoubleNear(1, kRounding), DoubleNear(0.9, kRounding),
                                        DoubleNear(1.2, kRounding), DoubleNear(1.1, kRounding)));
}

// In equilibrium the expected step is 0, so the proportion of positive answers is up / (up + down) = target, whatever the
// responder: over n answers the level moves by n (up (1 - p) - down p), so |p - target| = |end - start| / (n (up + down)).
class Converges : public testing::TestWithParam<double> {};

TEST_P(Converges, ToItsTargetForASimulatedResponder) {
  constexpr int kTrials = 4000;
  const double target = GetParam(), up = 0.1, down = up * (1 - target) / target;
  MethodRun run("weighted_up_down", {{"start", "1"},
                                     {"step", "0.1"},
                                     {"min", "-10"},
                                     {"trials", std::to_string(kTrials)},
                                     {"target", std::to_string(target)}});
  RandomStream random(7, "responder");
  const auto rises = [](double level) { return 1 / (1 + std::exp(-(level - 1) / 0.4)); };
  run.answer([&](double level) { return random.uniform() < rises(level); });
  int positive = 0;
  for (const Trial& trial : run.method().trials()) positive += trial.response->positive ? 1 : 0;
  // the level stays within 3 of its start: there the responder is right with 99.9 %
  EXPECT_NEAR(double(positive) / kTrials, target, 3 / (kTrials * (up + down)));
  // and the levels lie about the one where this responder has that proportion: 1 + 0.4 ln(p / (1 - p)); small steps leave
  // a bias of less than half a step, the mean of the last half scatters by less than a quarter of a step
  const std::vector<double> levels = run.levels();
  const double mean = std::accumulate(levels.begin() + kTrials / 2, levels.end(), 0.0) / (kTrials / 2);
  EXPECT_NEAR(mean, 1 + 0.4 * std::log(target / (1 - target)), 0.75 * up);
}

INSTANTIATE_TEST_SUITE_P(Targets, Converges, testing::Values(0.5, 0.75, 0.85));

TEST(WeightedUpDown, ResumesFromItsAnswers) {
  MethodRun run("weighted_up_down", {{"start", "1"}, {"step", "0.3"}, {"trials", "20"}});
  for (int i = 0; i < 10; ++i) run.method().respond({.positive = i % 3 != 0});
  run.method().discard();
  EXPECT_TRUE(run.resumes());
  EXPECT_FALSE(run.method().finished());
}

TEST(WeightedUpDown, RefusesAStartOutsideItsBounds) {
  EXPECT_THROW(MethodRun("weighted_up_down", {{"start", "2"}, {"step", "0.3"}, {"max", "1"}, {"trials", "4"}}),
               InputError);
}

}  // namespace
}  // namespace presa::psychophysics
