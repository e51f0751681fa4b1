#include "framework/psychophysics/observer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/psychophysics/constant_stimuli.h"
#include "framework/psychophysics/tally.h"
#include "tests/psychophysics/binomial_range.h"

namespace presa::psychophysics {
namespace {

// guess + (1 - guess - lapse) Phi(z); Phi(1) = 0.841344746068543.
TEST(PsychometricFunction, ByHand) {
  const PsychometricFunction linear{.threshold = 2, .spread = 0.5, .guess = 0.5, .lapse = 0.04};
  EXPECT_DOUBLE_EQ(linear(2), 0.73);
  EXPECT_NEAR(linear(2.5), 0.5 + 0.46 * 0.841344746068543, 1e-15);
  EXPECT_NEAR(linear(-100), 0.5, 1e-15);
  EXPECT_NEAR(linear(100), 0.96, 1e-15);
  const PsychometricFunction ln{.threshold = 2, .spread = 0.5, .scale = Scale::kLn};
  EXPECT_NEAR(ln(2 * std::exp(0.5)), 0.841344746068543, 1e-15);
  EXPECT_DOUBLE_EQ(ln(2), 0.5);
  EXPECT_EQ(ln(0), 0);
}

// 99.99 % of the binomial counts at each of nine levels; `kCorrect` is blind to the side, `kGreater` is not.
TEST(Observer, AnswersAsOftenAsItsFunctionSays) {
  const PsychometricFunction function{.threshold = 0.2, .spread = 0.3, .guess = 0.1, .lapse = 0.05};
  for (const Coding coding : {Coding::kCorrect, Coding::kGreater}) {
    ConstantStimuli method({.levels = {-0.8, -0.6, -0.4, -0.2, 0, 0.2, 0.4, 0.6, 0.8}, .per_level = 2000},
                           RandomStream(1, "order"));
    const Observer observer(function, coding, 17);
    while (!method.finished()) method.respond(observer.answer(method));
    for (const LevelCount& count : tally(method.trials(), Coding::kGreater)) {
      const double p = function(coding == Coding::kCorrect ? std::abs(count.level) : count.level);
      const BinomialRange range = binomialRange(2000, p, 0.9999);
      EXPECT_GE(static_cast<int>(count.k), range.low) << "level " << count.level;
      EXPECT_LE(static_cast<int>(count.k), range.high) << "level " << count.level;
    }
  }
}

// So that a resumed simulated session gets the answers of an unbroken one.
TEST(Observer, AnAnswerDependsOnSeedAndTrialOnly) {
  ConstantStimuli method({.levels = {0.2}, .per_level = 60}, RandomStream(1, "order"));
  const Observer one({.threshold = 0.2}, Coding::kGreater, 1), same({.threshold = 0.2}, Coding::kGreater, 1),
      other({.threshold = 0.2}, Coding::kGreater, 2);
  int differ = 0;
  while (!method.finished()) {
    EXPECT_EQ(one.answer(method), one.answer(method));
    EXPECT_EQ(one.answer(method), same.answer(method));
    differ += one.answer(method) != other.answer(method);
    method.respond(one.answer(method));
  }
  EXPECT_GT(differ, 10);
}

}  // namespace
}  // namespace presa::psychophysics
