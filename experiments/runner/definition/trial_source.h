#pragma once
#include <memory>
#include <optional>

#include "experiments/runner/definition/order.h"

namespace presa::experiment {

/// How one run of a trial ended.
enum class Outcome {
  kDone,
  kAborted,      ///< by a rule of the file: repeated up to its number of attempts
  kInterrupted,  ///< by a crash, a lost device or the operator's stop: repeated at once with the same seed
  kSkipped       ///< omitted by the operator
};

/// Selects the next trial. A pure function of the experiment and the outcomes so far: replaying the outcomes of a log
/// restores its state exactly. Thread: main.
class TrialSource {
 public:
  virtual ~TrialSource() = default;

  /// The trial to run now; null at the end of the session.
  virtual const PlannedTrial* next() const = 0;
  /// Reports the outcome of next(). Precondition: next() is not null. Pass an answer with kDone if and only if a method
  /// asks for one.
  virtual void finish(Outcome outcome, const std::optional<psychophysics::Response>& response = std::nullopt) = 0;

  virtual std::size_t done() const = 0;
  /// Trials given up after their last attempt, or skipped.
  virtual std::size_t missing() const = 0;
  /// Trials still to come, next() included; an upper bound where a method may stop early.
  virtual std::size_t left() const = 0;
  /// The method of the current block; null when there is none.
  virtual const psychophysics::Method* method() const { return nullptr; }
};

/// All trials of a subject's session. Without a method: the planned trials. With one: the method runs to its end in
/// every planned condition, in the order and as often as the design says, and offers an aborted trial again by its own
/// rules.
std::unique_ptr<TrialSource> makeTrialSource(const Experiment& experiment, int subject_number, int session);

}  // namespace presa::experiment
