#pragma once
#include "apps/experiment/export/bids.h"

namespace presa::experiment {

/// Writes the sessions as plain CSV into a new folder: trials.csv, one row for each run of a trial of all sessions, with
/// units in the header, and trials.json, what the columns mean; timeseries/sub-S01_ses-1_trial-001_run-1.csv for each recording of
/// a run that ended, `rate` rows a second (0: 1000, or the haptic rate when that is lower). Errors and result as exportBids, and
/// E935: a recording has fewer rows.
bool exportCsv(const std::vector<SourceSession>& sessions, const std::string& out, double rate, const Continue& more);

}  // namespace presa::experiment
