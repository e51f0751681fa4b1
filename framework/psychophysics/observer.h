#pragma once
#include <cstdint>

#include "framework/psychophysics/method.h"
#include "framework/psychophysics/psychometric_function.h"

namespace presa::psychophysics {

/// A simulated observer for tests and dry runs: a psychometric function and nothing else, no memory, no learning. A
/// model, not a person. Each trial has a stream of its own, so that an answer depends on the seed, the trial's number
/// and its level alone: a resumed session gets the answers of an unbroken one.
class Observer {
 public:
  /// `kCorrect` looks at |level|, `kGreater` at the level.
  Observer(PsychometricFunction function, Coding coding, std::uint64_t seed)
      : function_(function), coding_(coding), seed_(seed) {}

  const PsychometricFunction& function() const noexcept { return function_; }
  /// Answers the trial that the method offers now. Adjustment: stops at the threshold, off by a normal error of the
  /// function's spread (on its scale). Precondition: the method has not finished.
  Response answer(const Method& method) const;

 private:
  PsychometricFunction function_;
  Coding coding_;
  std::uint64_t seed_;
};

}  // namespace presa::psychophysics
