#pragma once
#include <span>
#include <string>
#include <vector>

#include "experiments/runner/definition/definition.h"
#include "experiments/runner/definition/running_aggregate.h"

namespace presa::experiment {

/// State machine of a running trial: current phase, end condition, aggregates. Fed with every haptic tick.
/// step() is nonblocking and does not allocate; call everything else from the main thread, before or after the trial.
class Trial {
 public:
  enum class State { kRunning, kDone, kAborted };
  struct Stretch {
    double begin = -1, end = -1;  ///< [s] since the start of the trial; -1: never reached
  };

  /// `experiment` must outlive the trial. `columns` in the order of Experiment::columns(), NaN for a word. `period`:
  /// haptic period [s].
  Trial(const Experiment& experiment, std::vector<double> columns, double period);

  /// Slots of Experiment::samples, to be filled before each step.
  std::span<double> samples() noexcept { return {values_.data(), experiment_.samples.size()}; }
  std::span<const double> samples() const noexcept { return {values_.data(), experiment_.samples.size()}; }
  /// One tick at `time` [s] since the start of the trial. Sets t and t_phase itself. No effect once the trial has
  /// ended.
  State step(double time) noexcept;
  /// Abort from outside: operator, lost device, end of the program.
  void abort(double time, std::string reason);

  State state() const noexcept { return state_; }
  /// Index of the current phase, or of the phase in which the trial ended.
  std::size_t phase() const noexcept { return phase_; }
  const std::vector<Stretch>& stretches() const noexcept { return stretches_; }
  /// True from the first tick of a phase that changes the friction of surfaces, if its condition held.
  bool frictionChanged() const noexcept { return friction_changed_; }
  /// Why the trial was aborted, in words; empty otherwise.
  std::string reason() const;
  /// Values of Experiment::names: columns (NaN for a word), `quality` (order of kQualityNames), measures (NaN where a
  /// phase has no matching sample).
  std::vector<double> results(std::span<const double> quality) const;
  /// Reason of the first exclusion rule that holds for these results; empty: the trial is valid.
  std::string exclusion(std::span<const double> results) const;

 private:
  enum class Cause { kNone, kGuard, kTimeout, kOutside };
  void enter(double time, std::size_t phase) noexcept;
  void end(double time, State state, Cause cause) noexcept;

  const Experiment& experiment_;
  double period_;
  std::vector<double> values_;                             // samples, then the columns that guards may use
  std::vector<double> columns_;                            // numbers of the presentation
  std::vector<std::vector<RunningAggregate>> aggregates_;  // by measure
  std::vector<ReactionClock> reactions_;                   // in the order of the reaction measures
  std::vector<Stretch> stretches_;
  State state_ = State::kRunning;
  Cause cause_ = Cause::kNone;
  std::string outside_reason_;
  std::size_t phase_ = 0;
  double held_since_ = -1;
  bool friction_changed_ = false;
};

}  // namespace presa::experiment
