#pragma once
#include <memory>
#include <optional>
#include <string>

#include "apps/experiment/operator/session_view.h"
#include "experiments/runner/psychophysics/adjustment.h"

namespace presa::experiment {

/// The person who runs a session: what is shown, what is asked for, what is written down. Hidden from the participant, who sees the
/// scene alone. Thread: main.
class Operator {
 public:
  enum class Wish { kNone, kPause, kRepeat, kSkip, kStop };

  virtual ~Operator() = default;

  /// Cheap, to be called often: shows when it is time.
  virtual void show(const SessionView& view) = 0;
  /// What was asked for since the last call; kPause is for after the trial.
  virtual Wish wish() = 0;
  /// A note that was written since; it goes into the log.
  virtual std::optional<std::string> takeNote() { return std::nullopt; }
  /// Waits between trials, for at least `seconds`, until the operator goes on: kNone, or kStop.
  virtual Wish await(const std::string& why, double seconds) = 0;
  /// The participant's answer, 1 or 2; none: the operator stops.
  virtual std::optional<int> ask(const std::string& question) = 0;
  virtual std::optional<psychophysics::AdjustmentKey> askAdjust(const std::string& question) = 0;
  /// One trial has ended.
  virtual void ended(const std::string& what) = 0;
  /// Nobody is there to be asked.
  virtual bool silent() const { return false; }
};

/// One line of progress; nothing is asked, Ctrl-C stops. `jobs`: trials to come.
std::unique_ptr<Operator> silentOperator(std::size_t jobs);
/// The whole screen of a terminal, with keys. E953 when there is none.
std::unique_ptr<Operator> terminalOperator();
/// The same in a window of its own, for a second screen. E703 without a display.
std::unique_ptr<Operator> windowOperator();

}  // namespace presa::experiment
