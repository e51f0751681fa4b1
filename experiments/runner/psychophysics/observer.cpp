#include "experiments/runner/psychophysics/observer.h"

#include <algorithm>
#include <cmath>

#include "framework/core/math/random.h"

namespace presa::psychophysics {

Response Observer::answer(const Method& method) const {
  const Stimulus& stimulus = method.next().value();
  RandomStream stream(seed_, "observer", stimulus.trial);
  if (stimulus.kind == TrialKind::kAdjustment) {
    const double share = std::clamp(stream.uniform(), 1e-12, 1 - 1e-12);
    const statistics::PsychometricFunction rise{function_.shape, function_.location, function_.spread};
    return {.value = rise.threshold(share).value()};
  }
  const double level = coding_ == Coding::kCorrect ? std::abs(stimulus.level) : stimulus.level;
  return method.responseFor(stream.uniform() < function_.probability(level));
}

}  // namespace presa::psychophysics
