#include "experiments/runner/psychophysics/tally.h"

#include <cmath>
#include <map>

namespace presa::psychophysics {

using statistics::StimulusLevel;

std::vector<StimulusLevel> tally(std::span<const Trial> trials, Coding coding) {
  std::map<double, StimulusLevel> by_level;
  for (const Trial& trial : trials) {
    if (!trial.response || trial.stimulus.kind != TrialKind::kTest) continue;
    const double level = coding == Coding::kCorrect ? std::abs(trial.stimulus.level) : trial.stimulus.level;
    StimulusLevel& count = by_level[level];
    count.x = level;
    ++count.trials;
    count.hits += trial.response->positive ? 1 : 0;
  }
  std::vector<StimulusLevel> counts;
  counts.reserve(by_level.size());
  for (const auto& [level, count] : by_level) counts.push_back(count);
  return counts;
}

StimulusLevel tallyCatch(std::span<const Trial> trials) {
  StimulusLevel count;
  for (const Trial& trial : trials) {
    if (!trial.response || trial.stimulus.kind != TrialKind::kCatch) continue;
    ++count.trials;
    count.hits += trial.response->positive ? 1 : 0;
  }
  return count;
}

}  // namespace presa::psychophysics
