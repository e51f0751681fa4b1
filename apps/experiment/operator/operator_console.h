#pragma once
#include <functional>
#include <string>

#include "apps/experiment/operator/operator.h"
#include "apps/experiment/operator/operator_observer.h"
#include "apps/experiment/participant_desk.h"
#include "apps/experiment/session_log.h"

namespace presa::experiment {

/// The session's interface to the operator: fills the display, takes requests, handles rests and notes. Thread: main.
class OperatorConsole {
 public:
  using Request = Operator::Request;
  /// `note` is called with each note of the operator. The desk has its window while the operator waits.
  OperatorConsole(const Experiment& experiment, const SessionStart& start, std::string language, Operator& person,
                  ParticipantDesk& desk, std::function<void(const std::string&)> note);

  ~OperatorConsole();
  OperatorConsole(const OperatorConsole&) = delete;
  OperatorConsole& operator=(const OperatorConsole&) = delete;

  /// Shows the participant's instructions before the first trial. False: the session is to stop.
  bool welcome();
  /// Call when a trial begins; `source` is the source of the trials.
  void begin(const PlannedTrial& trial, const TrialSource& source);
  /// Call repeatedly during the trial with its time [s].
  void look(double time);
  /// The operator's request to end the trial now: skip, repeat or stop. kNone: the trial continues.
  Request ending() const noexcept { return ending_; }
  /// Call when a trial has ended. Waits for the end of a pause or rest. False: the session is to stop.
  bool between(const std::string& what, const TrialSource& source);

  /// The values that the haptic thread writes; null when there is no display.
  TrialLive* live() noexcept { return person_.silent() ? nullptr : &live_; }
  Operator& person() noexcept { return person_; }
  ParticipantDesk& desk() noexcept { return desk_; }
  const std::string& language() const noexcept { return language_; }

 private:
  void take();
  double secondsLeft(double time) const;

  const Experiment& experiment_;
  const SessionStart& start_;
  std::string language_;
  Operator& person_;
  ParticipantDesk& desk_;
  std::function<void(const std::string&)> note_;
  TrialLive live_;
  SessionView view_;
  Request ending_ = Request::kNone;
  bool pause_ = false, practice_ = false;
  std::int64_t begin_ns_;
  std::size_t ended_ = 0;               // trials since begin_ns_
  std::size_t since_rest_ = 0;          // trials since the last rest, without practice
  double min_duration_ = 0, each_ = 0;  // duration of a trial [s]: min; mean of the ended ones, breaks included
};

}  // namespace presa::experiment
