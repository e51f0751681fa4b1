#pragma once
#include <span>
#include <string>
#include <vector>

#include "experiments/runner/definition/definition.h"
#include "experiments/runner/definition/running_aggregate.h"

namespace presa::experiment {

/// One trial as it goes on: which phase it is in, what ends it, what its samples come to. Fed with every haptic tick.
/// step() is nonblocking and takes no memory; everything else is for the main thread, before or after.
class Trial {
 public:
  enum class State { kRunning, kDone, kAborted };
  struct Stretch {
    double begin = -1, end = -1;  ///< [s] since the trial began; -1: never reached
  };

  /// `experiment` outlives the trial. `columns` as Experiment::columns() lists them, NaN for a word. `period` of the haptic tick [s].
  Trial(const Experiment& experiment, std::vector<double> columns, double period);

  /// Slots of Experiment::samples, to be filled before each step.
  std::span<double> samples() noexcept { return {values_.data(), experiment_.samples.size()}; }
  std::span<const double> samples() const noexcept { return {values_.data(), experiment_.samples.size()}; }
  /// One tick at `time` [s] since the trial began. Sets t and t_phase itself. Once not running, it stays as it is.
  State step(double time) noexcept;
  /// From outside: the operator, a lost device, the end of the program.
  void abort(double time, std::string reason);

  State state() const noexcept { return state_; }
  /// Index of the phase going on, or in which the trial ended.
  std::size_t phase() const noexcept { return phase_; }
  const std::vector<Stretch>& stretches() const noexcept { return stretches_; }
  /// A phase that changes the friction of surfaces has begun, and its condition held: from that phase's first tick on.
  bool frictionChanged() const noexcept { return friction_changed_; }
  /// Why it was aborted, in words; empty otherwise.
  std::string reason() const;
  /// Values of Experiment::names: columns (NaN for a word), `quality` (order of kQualityNames), measures (NaN where a phase
  /// had no such sample).
  std::vector<double> results(std::span<const double> quality) const;
  /// Reason of the first rule of exclusion that holds for these results; empty: the trial counts.
  std::string exclusion(std::span<const double> results) const;

 private:
  enum class Cause { kNone, kGuard, kTimeout, kOutside };
  void enter(double time, std::size_t phase) noexcept;
  void end(double time, State state, Cause cause) noexcept;

  const Experiment& experiment_;
  double period_;
  std::vector<double> values_;                             // samples, then the columns that guards may ask for
  std::vector<double> columns_;                            // numbers of the presentation
  std::vector<std::vector<RunningAggregate>> aggregates_;  // by measure
  std::vector<ReactionClock> reactions_;                   // in the order of the measures that are one
  std::vector<Stretch> stretches_;
  State state_ = State::kRunning;
  Cause cause_ = Cause::kNone;
  std::string outside_reason_;
  std::size_t phase_ = 0;
  double held_since_ = -1;
  bool friction_changed_ = false;
};

}  // namespace presa::experiment
