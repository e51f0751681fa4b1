#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/experiment/respondent.h"
#include "apps/experiment/trial_run.h"
#include "experiments/runner/definition/trial_source.h"

namespace presa::experiment {

/// Result of one run of a trial: all its presentations and the answer.
struct Conducted {
  Outcome outcome = Outcome::kInterrupted;
  std::string reason;    ///< reason of an abort or interruption
  std::string excluded;  ///< exclusion rule that one of the presentations met; empty: the trial counts
  std::vector<TrialResult> presented;
  std::optional<psychophysics::Response> response;

  bool stopped() const { return presented.empty() || presented.back().stopped || unanswered; }
  bool unanswered = false;
};

/// Runs the presentations of a trial and gets the answer. `files`: path of the recording of each presentation (empty:
/// no recording). `respondent`: null without a procedure. Throws InputError.
Conducted conduct(const Experiment& experiment, const PlannedTrial& trial, const std::vector<std::string>& files,
                  const TrialSetting& setting, Respondent* respondent);

}  // namespace presa::experiment
