#include "framework/psychophysics/tally.h"

#include <cmath>
#include <map>

namespace presa::psychophysics {

std::vector<LevelCount> tally(std::span<const Trial> trials, Coding coding) {
  std::map<double, LevelCount> by_level;
  for (const Trial& trial : trials) {
    if (!trial.response || trial.stimulus.kind != TrialKind::kTest) continue;
    const double level = coding == Coding::kCorrect ? std::abs(trial.stimulus.level) : trial.stimulus.level;
    LevelCount& count = by_level[level];
    count.level = level;
    ++count.n;
    count.k += trial.response->positive ? 1 : 0;
  }
  std::vector<LevelCount> counts;
  counts.reserve(by_level.size());
  for (const auto& [level, count] : by_level) counts.push_back(count);
  return counts;
}

LevelCount tallyCatch(std::span<const Trial> trials) {
  LevelCount count;
  for (const Trial& trial : trials) {
    if (!trial.response || trial.stimulus.kind != TrialKind::kCatch) continue;
    ++count.n;
    count.k += trial.response->positive ? 1 : 0;
  }
  return count;
}

}  // namespace presa::psychophysics
