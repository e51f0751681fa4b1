#pragma once
#include <cstdint>

#include "experiments/runner/psychophysics/method.h"
#include "experiments/runner/statistics/psychometric_function.h"

namespace presa::psychophysics {

/// A simulated observer for tests and dry runs: a psychometric function of the level (of its logarithm where the method
/// steps on an axis of ratios) and nothing else, no memory, no learning. A
/// model, not a person. Each trial has a stream of its own, so that an answer depends on the seed, the trial's number
/// and its level alone: a resumed session gets the answers of an unbroken one.
class Observer {
 public:
  /// `kCorrect` looks at |level|, `kGreater` at the level.
  Observer(statistics::PsychometricFunction function, Coding coding, std::uint64_t seed)
      : function_(function), coding_(coding), seed_(seed) {}

  const statistics::PsychometricFunction& function() const noexcept { return function_; }
  /// Answers the trial that the method offers now. Adjustment: stops at a level drawn from the
  /// distribution that the function without guess and lapse is. Precondition: the method has not finished.
  Response answer(const Method& method) const;

 private:
  statistics::PsychometricFunction function_;
  Coding coding_;
  std::uint64_t seed_;
};

}  // namespace presa::psychophysics
