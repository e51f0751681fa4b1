#pragma once
#include "apps/experiment/conduct.h"
#include "apps/experiment/session_log.h"

/// Builds the records of a session's log.
namespace presa::experiment {

/// `run`: number of the run of this trial, from 1.
Json trialBegin(const Experiment& experiment, const PlannedTrial& trial, int run, bool recording);
/// Does not contain the checksums of the files: they are known only once the files are on disk.
Json trialEnd(const Experiment& experiment, const PlannedTrial& trial, const Conducted& result);
Json stimulusJson(const psychophysics::Stimulus& stimulus);
Json factsJson(const std::vector<DeviceFact>& facts);

}  // namespace presa::experiment
