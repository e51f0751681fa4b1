#pragma once
#include <memory>
#include <optional>
#include <span>

#include "apps/experiment/operator/operator.h"
#include "apps/experiment/trial_run.h"

namespace presa::experiment {

/// Who answers the question of a trial. Thread: main.
class Respondent {
 public:
  virtual ~Respondent() = default;
  /// Place chosen, 1 or 2; yes is 1. None: nobody answers any more, the session is to stop.
  virtual std::optional<int> choose(const PlannedTrial& trial, std::span<const TrialResult> presented) = 0;
  /// What to do with the level after a round of adjustment, numbered from 1.
  virtual std::optional<psychophysics::AdjustmentKey> adjust(const PlannedTrial& trial, const TrialResult& standard,
                                                             const TrialResult& comparison, int round) = 0;
};

/// The experiment's simulated observer, which is a model and not a person: compares the measure it is told to, with noise of its own
/// for every trial. Needs Experiment::procedure with an observer.
std::unique_ptr<Respondent> simulatedRespondent(const Experiment& experiment, int subject_number);

/// The participant, whose answer is typed in: at the operator's terminal, after the text "question" of the experiment.
std::unique_ptr<Respondent> keyboardRespondent(const Experiment& experiment, Operator& person,
                                               const std::string& language);

}  // namespace presa::experiment
