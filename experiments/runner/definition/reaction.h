#pragma once
#include <vector>

#include "experiments/runner/definition/expression.h"

namespace presa::experiment {

/// When a number of the samples rises after an event: the beginning of `phase`.
///   baseline   mean m and standard deviation s (of n - 1) of the last `window` seconds of phase `baseline`
///   response   the first sample of `phase` above m + max(threshold, sds * s)
///   onset      searched backwards from there: the first sample of the unbroken row above m + min(2 s, the above) that holds
///              the response, within `phase`
/// The result is the onset in seconds since `phase` began. A row that was there when the phase began gives 0: the rise is
/// older than the event.
struct Reaction {
  Expression value;  ///< over Experiment::samples
  std::size_t baseline = 0, phase = 0;
  double threshold = 0;  ///< [unit of value]
  double sds = 0;
  double window = 0.2;  ///< [s]
};

/// Finds the onset while samples come in. Searching backwards takes no memory of them: it is known at each sample when the row
/// above the lower line began. Only the window of the baseline is kept, in memory taken by the constructor.
/// Thread: haptic; nonblocking.
class ReactionClock {
 public:
  /// `what` outlives it. `period` of the samples [s].
  ReactionClock(const Reaction& what, double period);

  void add(std::size_t phase, std::span<const double> samples, double phase_time) noexcept;
  /// [s] since the phase began; NaN: there was none, or no baseline to tell it from.
  double onset() const noexcept { return onset_; }

 private:
  void remember(double value) noexcept;
  void endBaseline() noexcept;

  const Reaction* what_;
  std::vector<double> window_;  // a ring
  std::size_t remembered_ = 0;  // values in all
  bool measured_ = false;
  double left_ = 0, response_ = 0;  // the lower and the upper line
  double above_since_, onset_;
};

}  // namespace presa::experiment
