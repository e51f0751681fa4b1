#include "experiments/runner/psychophysics/observer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/runner/psychophysics/constant_stimuli.h"
#include "experiments/runner/psychophysics/tally.h"
#include "tests/experiments/runner/psychophysics/binomial_range.h"

namespace presa::psychophysics {
namespace {

using statistics::PsychometricFunction;
using statistics::StimulusLevel;

// Bounds: the 99.99 % range of the binomial counts at each of nine levels. `kCorrect` ignores the sign of the level.
TEST(Observer, AnswersAsOftenAsItsFunctionSays) {
  const PsychometricFunction function{.location = 0.2, .spread = 0.3, .guess = 0.1, .lapse = 0.05};
  for (const Coding coding : {Coding::kCorrect, Coding::kGreater}) {
    ConstantStimuli method({.levels = {-0.8, -0.6, -0.4, -0.2, 0, 0.2, 0.4, 0.6, 0.8}, .per_level = 2000},
                           RandomStream(1, "order"));
    const Observer observer(function, coding, 17);
    while (!method.finished()) method.respond(observer.answer(method));
    for (const StimulusLevel& count : tally(method.trials(), Coding::kGreater)) {
      const double p = function.probability(coding == Coding::kCorrect ? std::abs(count.x) : count.x);
      const BinomialRange range = binomialRange(2000, p, 0.9999);
      EXPECT_GE(count.hits, range.low) << "level " << count.x;
      EXPECT_LE(count.hits, range.high) << "level " << count.x;
    }
  }
}

// A resumed simulated session must get the same answers as an uninterrupted one.
TEST(Observer, AnAnswerDependsOnSeedAndTrialOnly) {
  ConstantStimuli method({.levels = {0.2}, .per_level = 60}, RandomStream(1, "order"));
  const Observer one({.location = 0.2}, Coding::kGreater, 1), same({.location = 0.2}, Coding::kGreater, 1),
      other({.location = 0.2}, Coding::kGreater, 2);
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
