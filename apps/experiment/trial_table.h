#pragma once
#include <string>

#include "apps/experiment/session_log.h"
#include "experiments/runner/definition/definition.h"

namespace presa::experiment {

/// One row per run of a trial (CSV): who, which, the condition, how it ended, measures and quality; units stand in the
/// header in brackets, "n/a" where there is nothing. A function of the log alone.
std::string trialTable(const Experiment& experiment, const SessionLog& log);

/// What each column means, with its unit.
std::string tableColumnsJson(const Experiment& experiment);

}  // namespace presa::experiment
