#pragma once
#include <cstdint>

#include "experiments/runner/psychophysics/method.h"
#include "experiments/runner/statistics/psychometric_function.h"

namespace presa::psychophysics {

/// A simulated observer for tests and dry runs; a model, not a person. It answers by a psychometric function of the
/// level (of its logarithm where the method's axis is logarithmic), without memory or learning. Each trial has its own
/// random stream, so an answer depends only on the seed, the trial number and the level, and a resumed session gets the
/// same answers as an uninterrupted one.
class Observer {
 public:
  /// `kCorrect` looks at |level|, `kGreater` at the level.
  Observer(statistics::PsychometricFunction function, Coding coding, std::uint64_t seed)
      : function_(function), coding_(coding), seed_(seed) {}

  const statistics::PsychometricFunction& function() const noexcept { return function_; }
  /// Answers the trial that the method offers now. Adjustment: stops at a level drawn from the distribution F of the
  /// function (without guess and lapse). Precondition: the method has not finished.
  Response answer(const Method& method) const;

 private:
  statistics::PsychometricFunction function_;
  Coding coding_;
  std::uint64_t seed_;
};

}  // namespace presa::psychophysics
