#pragma once
#include "apps/experiment/export/bids.h"

namespace presa::experiment {

/// Writes the sessions as plain CSV into a new folder:
///   trials.csv    one row per run of a trial, all sessions, units in the header
///   trials.json   the meaning of the columns
///   timeseries/sub-S01_ses-1_trial-001_run-1.csv   one per recording of a run that ended, `rate` rows per second
///                                                  (0: 1000, or the haptic rate if that is lower)
/// Errors and result as exportBids(), and E935: a recording has fewer rows per second than `rate`.
bool exportCsv(const std::vector<SourceSession>& sessions, const std::string& out, double rate, const Continue& more);

}  // namespace presa::experiment
