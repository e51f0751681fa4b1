#pragma once
#include <functional>
#include <string>

#include "apps/experiment/operator/operator.h"
#include "apps/experiment/operator/operator_tap.h"
#include "apps/experiment/session_log.h"

namespace presa::experiment {

/// The operator's side of a session: what is shown, what he wants, rests and notes. Thread: main.
class Desk {
 public:
  using Wish = Operator::Wish;
  /// `note`: where a note goes that he has written.
  Desk(const Experiment& experiment, const SessionStart& start, std::string language, Operator& person,
       std::function<void(const std::string&)> note);

  /// Before the first trial: what the participant is told. False: the session is to stop.
  bool welcome();
  /// A trial begins; `source` offers it.
  void begin(const PlannedTrial& trial, const TrialSource& source);
  /// Now and then while it goes on, at its time [s].
  void look(double time);
  /// The trial is to end now: skip, repeat or stop. kNone: it goes on.
  Wish ending() const noexcept { return ending_; }
  /// The trial has ended. Waits where there is a pause or a rest; false: the session is to stop.
  bool between(const std::string& what, const TrialSource& source);

  /// Where the haptic thread writes; null when nobody looks.
  TrialLive* live() noexcept { return person_.silent() ? nullptr : &live_; }
  Operator& person() noexcept { return person_; }
  const std::string& language() const noexcept { return language_; }

 private:
  void take();
  double secondsLeft(double time) const;

  const Experiment& experiment_;
  const SessionStart& start_;
  std::string language_;
  Operator& person_;
  std::function<void(const std::string&)> note_;
  TrialLive live_;
  SessionView view_;
  Wish ending_ = Wish::kNone;
  bool pause_ = false, practice_ = false;
  std::int64_t begin_ns_;
  std::size_t ended_ = 0;        // trials since begin_ns_
  std::size_t since_rest_ = 0;   // trials that count
  double least_ = 0, each_ = 0;  // length of a trial [s]: at least; of those that ended, with all between them
};

}  // namespace presa::experiment
