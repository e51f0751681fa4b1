#pragma once
#include <span>
#include <vector>

#include "experiments/runner/psychophysics/method.h"
#include "experiments/runner/statistics/psychometric.h"

namespace presa::psychophysics {

/// Answered test trials by rising level, x, as a psychometric fit takes them; catch and discarded trials do not count.
/// `kCorrect` pools both sides of the standard, |level|.
std::vector<statistics::StimulusLevel> tally(std::span<const Trial> trials, Coding coding);

/// Catch trials (x is 0): how many were answered, how many positively.
statistics::StimulusLevel tallyCatch(std::span<const Trial> trials);

}  // namespace presa::psychophysics
