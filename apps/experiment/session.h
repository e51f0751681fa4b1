#pragma once
#include <memory>
#include <string>

#include "apps/experiment/conduct.h"
#include "apps/experiment/operator/operator_console.h"
#include "apps/experiment/session_log.h"

namespace presa::experiment {

/// A session of one subject: its folder, its log, and the trials still to run. Every step is on disk before the next
/// one begins, so that a crash loses at most the current trial. Thread: main.
class SubjectSession {
 public:
  /// Creates a session in DATA/sub-ID/ses-N; paths in its log are relative to that folder. Throws InputError E920 when
  /// the session exists, E925 when the folder cannot be created.
  static SubjectSession begin(const Experiment& experiment, SessionStart start, const std::string& data);
  /// Continues a session: the queue of trials and the file names are rebuilt from the log; an interrupted run is marked
  /// and its trial comes next. Throws InputError E926 when experiment, scene or rig have changed since the session
  /// began, E936 when a file that they name has changed.
  static SubjectSession resume(const Experiment& experiment, const SessionFolder& folder);

  enum class End { kComplete, kStopped, kFault };
  /// Runs the remaining trials. kStopped: Ctrl-C or the operator; kFault: a device, the dynamics or the recording
  /// failed, or a procedure's trial was aborted too often, see fault(). The interrupted trial is marked and comes again
  /// after resume. `language`: language of the texts shown. Throws std::system_error when the disk fails (earlier
  /// records stay intact), InputError E928 when trials ask a question and there is nobody to answer.
  End run(Operator& person, const std::string& language);

  const SessionFolder& folder() const noexcept { return folder_; }
  const TrialSource& trials() const noexcept { return *trials_; }
  /// The reason why run() ended with kFault.
  std::string fault() const { return log_.runs.empty() ? "" : log_.runs.back().end.value("reason", ""); }
  const SessionStart& start() const noexcept { return log_.start; }
  int runsMade() const noexcept { return static_cast<int>(log_.runs.size()); }

 private:
  SubjectSession(const Experiment& experiment, SessionFolder folder, SessionLog log, Journal journal);
  /// Null without a procedure.
  std::unique_ptr<Respondent> respondentFor(OperatorConsole& console) const;
  Conducted conductOne(const PlannedTrial& trial, const LoggedRun& run, OperatorConsole& console,
                       Respondent* respondent) const;
  LoggedRun& beginRun(const PlannedTrial& trial);
  void endRun(LoggedRun& run, const PlannedTrial& trial, const Conducted& result);
  void writeTable() const;

  const Experiment& experiment_;
  SessionFolder folder_;
  SessionLog log_;
  Journal journal_;
  std::unique_ptr<TrialSource> trials_;
};

}  // namespace presa::experiment
