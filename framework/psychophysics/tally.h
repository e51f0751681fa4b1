#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "framework/psychophysics/method.h"

namespace presa::psychophysics {

/// All answers at one level: what a psychometric fit takes.
struct LevelCount {
  double level = 0;
  std::size_t n = 0;  ///< answers
  std::size_t k = 0;  ///< positive ones
  bool operator==(const LevelCount&) const = default;
};

/// Answered test trials by rising level; catch and discarded trials do not count. `kCorrect` pools both sides of the
/// standard, |level|.
std::vector<LevelCount> tally(std::span<const Trial> trials, Coding coding);

/// Catch trials (`level` 0): how many were answered, how many positively.
LevelCount tallyCatch(std::span<const Trial> trials);

}  // namespace presa::psychophysics
