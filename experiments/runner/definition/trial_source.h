#pragma once
#include <memory>
#include <optional>

#include "experiments/runner/definition/order.h"

namespace presa::experiment {

/// How one run of a trial ended.
enum class Outcome {
  kDone,
  kAborted,      ///< by a rule of the file: tried again as often as that allows
  kInterrupted,  ///< by a crash, a lost device or the operator's stop: run again at once, with the same seed
  kSkipped       ///< the operator leaves it out
};

/// Which trial is next. A pure function of the experiment and of what has become of the trials so far: replaying the runs of a log
/// rebuilds it exactly. Thread: main.
class TrialSource {
 public:
  virtual ~TrialSource() = default;

  /// Null at the end.
  virtual const PlannedTrial* next() const = 0;
  /// What became of next(); there is one. An answer goes with kDone where a method asks for one, and only there.
  virtual void finish(Outcome outcome, const std::optional<psychophysics::Response>& response = std::nullopt) = 0;

  virtual std::size_t done() const = 0;
  /// Trials given up after their last attempt, or skipped.
  virtual std::size_t missing() const = 0;
  /// Trials still to come, next() included; at most, where a method ends when it knows enough.
  virtual std::size_t left() const = 0;
  /// Of the method that is going on; null when there is none.
  virtual const psychophysics::Method* method() const { return nullptr; }
};

/// All of a subject's session. Without a method: the planned trials. With one: the method, run to its end in every condition, in the
/// order and as often as the design says; a trial that was aborted is offered again by the method's own rules.
std::unique_ptr<TrialSource> makeTrialSource(const Experiment& experiment, int subject_number, int session);

}  // namespace presa::experiment
