#include "framework/psychophysics/observer.h"

#include <cmath>

#include "framework/math/random.h"

namespace presa::psychophysics {

Response Observer::answer(const Method& method) const {
  const Stimulus& stimulus = method.next().value();
  RandomStream stream(seed_, "observer", stimulus.trial);
  if (stimulus.kind == TrialKind::kAdjustment) {
    const bool linear = function_.scale == Scale::kLinear;
    return {.value = linear ? function_.threshold + function_.spread * stream.normal()
                            : stream.logNormal(function_.threshold, function_.spread)};
  }
  const double level = coding_ == Coding::kCorrect ? std::abs(stimulus.level) : stimulus.level;
  return method.responseFor(stream.uniform() < function_(level));
}

}  // namespace presa::psychophysics
