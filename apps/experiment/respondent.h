#pragma once
#include <memory>
#include <optional>
#include <span>

#include "apps/experiment/operator/operator.h"
#include "apps/experiment/participant_desk.h"
#include "apps/experiment/trial_run.h"

namespace presa::experiment {

/// Answers the question of a trial: a person or a model. Thread: main.
class Respondent {
 public:
  virtual ~Respondent() = default;
  /// The chosen presentation, 1 or 2; "yes" is 1. No value: the session is to stop.
  virtual std::optional<int> choose(const PlannedTrial& trial, std::span<const TrialResult> presented) = 0;
  /// The change of the level after a round of adjustment; rounds count from 1.
  virtual std::optional<psychophysics::AdjustmentKey> adjust(const PlannedTrial& trial, const TrialResult& standard,
                                                             const TrialResult& comparison, int round) = 0;
};

/// The experiment's simulated observer, a model: compares the measure that the experiment names, with fresh noise in
/// every trial. Needs Experiment::procedure with an observer.
std::unique_ptr<Respondent> simulatedRespondent(const Experiment& experiment, int subject_number);

/// The participant, asked with the experiment's text "question". The answer is typed in the participant's window or at the
/// operator's terminal.
std::unique_ptr<Respondent> keyboardRespondent(const Experiment& experiment, Operator& person, ParticipantDesk& desk,
                                               const std::string& language);

}  // namespace presa::experiment
