#pragma once
#include <span>
#include <vector>

#include "experiments/runner/psychophysics/method.h"
#include "experiments/runner/statistics/psychometric.h"

namespace presa::psychophysics {

/// Counts of answered test trials per level x in ascending order, the input of a psychometric fit; catch and discarded
/// trials are left out. `kCorrect` pools both sides of the standard: x is |level|.
std::vector<statistics::StimulusLevel> tally(std::span<const Trial> trials, Coding coding);

/// Counts of catch trials (x is 0): answered, and answered positively.
statistics::StimulusLevel tallyCatch(std::span<const Trial> trials);

}  // namespace presa::psychophysics
