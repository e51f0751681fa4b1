#include "apps/studies/cost/reference_levels.h"

#include <algorithm>

namespace presa::cost {
namespace {

/// How many sets of the knob a level uses: the last of them counts.
std::size_t usedAt(const Study& study, std::size_t level, std::size_t knob, std::size_t limit) {
  return std::min(study.finer[knob].size() - study.reference.size() + level + 1, limit);
}

}  // namespace

FinerLimits noLimits(const Study& study) {
  FinerLimits limits;
  for (const std::vector<std::string>& sets : study.finer) limits.push_back(sets.size());
  return limits;
}

std::vector<std::string> setsOfLevel(const Study& study, std::size_t level, const FinerLimits& limits) {
  std::vector<std::string> sets = study.reference[level];
  for (std::size_t knob = 0; knob < study.finer.size(); ++knob) {
    const std::size_t used = usedAt(study, level, knob, limits[knob]);
    if (used > 0) sets.push_back(study.finer[knob][used - 1]);
  }
  return sets;
}

FinerLimits limitsThatRun(const Study& study, std::size_t level, const FinerLimits& limits,
                          const std::function<bool(const FinerLimits&)>& runs) {
  for (std::size_t knob = 0; knob < limits.size(); ++knob) {
    FinerLimits one = limits;
    one[knob] = usedAt(study, level, knob, limits[knob]);
    while (one[knob] > 0) {
      --one[knob];
      if (runs(one)) return one;
    }
  }
  return FinerLimits(limits.size(), 0);
}

std::vector<std::string> keptKnobs(const Study& study, std::size_t level, const FinerLimits& limits) {
  std::vector<std::string> kept;
  for (std::size_t knob = 0; knob < limits.size(); ++knob) {
    const std::size_t used = usedAt(study, level, knob, limits[knob]);
    if (used == usedAt(study, level, knob, study.finer[knob].size())) continue;
    const std::string& set = study.finer[knob][used > 0 ? used - 1 : 0];
    kept.push_back(used > 0 ? set : set.substr(0, set.find('=')) + " as in the scene");
  }
  return kept;
}

}  // namespace presa::cost
