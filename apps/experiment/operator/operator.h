#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "apps/experiment/operator/session_view.h"
#include "experiments/runner/psychophysics/adjustment.h"

namespace presa::experiment {

/// The person who runs a session: sees its state, requests pauses and stops, writes notes. The participant sees only
/// the scene. Thread: main.
class Operator {
 public:
  enum class Request { kNone, kPause, kRepeat, kSkip, kStop };

  virtual ~Operator() = default;

  /// Updates the display when it is due. Cheap: call it often.
  virtual void show(const SessionView& view) = 0;
  /// The request made since the last call. kPause takes effect after the trial.
  virtual Request request() = 0;
  /// The note written since the last call; it goes into the log.
  virtual std::optional<std::string> takeNote() { return std::nullopt; }
  /// Waits between trials, for at least `seconds`, until the operator continues. Returns kNone or kStop.
  virtual Request await(const std::string& why, double seconds) = 0;
  /// The participant's answer, 1 or 2, typed by either; no value: the operator stops the session.
  virtual std::optional<int> ask(const std::string& question) = 0;
  virtual std::optional<psychophysics::AdjustmentKey> askAdjust(const std::string& question) = 0;
  /// `participant` is called some ten times a second while the operator waits or asks; it returns the key that the
  /// participant has pressed, which answers as the operator's would, or 0.
  virtual void listenTo(std::function<char()> participant) { (void)participant; }
  /// Called when a trial has ended.
  virtual void ended(const std::string& what) = 0;
  /// True when there is no person to ask.
  virtual bool silent() const { return false; }
};

/// Shows one line of progress and asks no questions; Ctrl-C stops. `jobs`: number of trials to come.
std::unique_ptr<Operator> silentOperator(std::size_t jobs);
/// Uses the whole screen of the terminal, and its keys. E953 without a terminal.
std::unique_ptr<Operator> terminalOperator();
/// The same in a separate window, for a second screen. E703 without a display.
std::unique_ptr<Operator> windowOperator();

}  // namespace presa::experiment
