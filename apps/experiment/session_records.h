#pragma once
#include "apps/experiment/conduct.h"
#include "apps/experiment/session_log.h"

/// Records of a session's log, from what they tell of.
namespace presa::experiment {

/// `run`: how often this trial has been begun, from 1.
Json trialBegin(const Experiment& experiment, const PlannedTrial& trial, int run, bool recording);
/// Without the sums of the files, which are known once they are on the disk.
Json trialEnd(const Experiment& experiment, const PlannedTrial& trial, const Conducted& result);
Json stimulusJson(const psychophysics::Stimulus& stimulus);
Json factsJson(const std::vector<DeviceFact>& facts);

}  // namespace presa::experiment
