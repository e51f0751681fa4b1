#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/experiment/respondent.h"
#include "apps/experiment/trial_run.h"
#include "experiments/runner/definition/trial_source.h"

namespace presa::experiment {

/// One run of a trial, all its presentations and the answer.
struct Conducted {
  Outcome outcome = Outcome::kInterrupted;
  std::string reason;    ///< of an abort or interruption
  std::string excluded;  ///< rule that holds for one of the presentations; empty: the trial counts
  std::vector<TrialResult> presented;
  std::optional<psychophysics::Response> response;

  bool stopped() const { return presented.empty() || presented.back().stopped || unanswered; }
  bool unanswered = false;
};

/// Presents what the trial asks for, one recording each (`files`: paths, none when empty), and gets the answer. `respondent`: null
/// without a procedure. Throws InputError.
Conducted conduct(const Experiment& experiment, const PlannedTrial& trial, const std::vector<std::string>& files,
                  const TrialSetting& setting, Respondent* respondent);

}  // namespace presa::experiment
