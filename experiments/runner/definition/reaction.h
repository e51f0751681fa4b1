#pragma once
#include <vector>

#include "experiments/runner/definition/expression.h"

namespace presa::experiment {

/// Reaction time: when a sampled number rises after an event, the start of `phase`.
///   baseline   mean m and standard deviation s (n - 1) over the last `window` seconds of phase `baseline`
///   response   the first sample of `phase` above m + max(threshold, sds * s)
///   onset      start of the unbroken run of samples that contains the response and lies above
///              min(m + 2 s, response line), within `phase`
/// The result is the onset in seconds since the start of `phase`. A run that already exists at that start gives 0: the
/// rise began before the event.
struct Reaction {
  Expression value;  ///< over Experiment::samples
  std::size_t baseline = 0, phase = 0;
  double threshold = 0;  ///< [unit of value]
  double sds = 0;
  double window = 0.2;  ///< [s]
};

/// Finds the onset online. It tracks when the current run above the lower line began, so no backward search is needed.
/// Only the baseline window is stored, in memory allocated by the constructor.
/// Thread: haptic; nonblocking.
class ReactionClock {
 public:
  /// `what` must outlive this object. `period` is the sample period [s].
  ReactionClock(const Reaction& what, double period);

  void add(std::size_t phase, std::span<const double> samples, double phase_time) noexcept;
  /// [s] since the start of the phase; NaN: no response, or no baseline.
  double onset() const noexcept { return onset_; }

 private:
  void remember(double value) noexcept;
  void endBaseline() noexcept;

  const Reaction* what_;
  std::vector<double> window_;  // ring buffer
  std::size_t remembered_ = 0;  // number of baseline samples, including overwritten ones
  bool measured_ = false;
  double left_ = 0, response_ = 0;  // lower (onset) and upper (response) line
  double above_since_, onset_;
};

}  // namespace presa::experiment
