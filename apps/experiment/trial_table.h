#pragma once
#include <string>

#include "apps/experiment/session_log.h"
#include "experiments/runner/definition/definition.h"

namespace presa::experiment {

/// CSV with one row per run of a trial: subject, trial, condition, outcome, measures and quality. Units are in brackets
/// in the header, missing values are "n/a". A function of the log alone.
std::string trialTable(const Experiment& experiment, const SessionLog& log);

/// JSON with the meaning and unit of each column.
std::string tableColumnsJson(const Experiment& experiment);

}  // namespace presa::experiment
