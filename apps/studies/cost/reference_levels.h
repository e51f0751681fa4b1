#pragma once
#include <functional>
#include <string>
#include <vector>

#include "apps/studies/cost/study.h"

namespace presa::cost {

/// For each knob of Study::finer, how many of its sets may be used, from the first one on; 0: as in the scene.
using FinerLimits = std::vector<std::size_t>;

/// No limits: the levels as planned.
FinerLimits noLimits(const Study& study);

/// All sets of one level of the reference.
std::vector<std::string> setsOfLevel(const Study& study, std::size_t level, const FinerLimits& limits);

/// Lower limits, for a level that cannot be run with `limits`: of one knob, where that is enough, or else of all.
/// `runs`: whether the level can be run with others.
FinerLimits limitsThatRun(const Study& study, std::size_t level, const FinerLimits& limits,
                          const std::function<bool(const FinerLimits&)>& runs);

/// The knobs that limits keep coarser than planned at a level, with their values there.
std::vector<std::string> keptKnobs(const Study& study, std::size_t level, const FinerLimits& limits);

}  // namespace presa::cost
