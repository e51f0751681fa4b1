#pragma once
#include <memory>
#include <string>

#include "apps/experiment/conduct.h"
#include "apps/experiment/operator/desk.h"
#include "apps/experiment/session_log.h"

namespace presa::experiment {

/// A session of one subject: its folder, its log, and the trials that are still to come. Everything that a crash must not take away
/// is on disk before the next step is taken. Thread: main.
class SubjectSession {
 public:
  /// A new one in DATA/sub-ID/ses-N; the log names files from that folder on. Throws InputError E920 when it exists, E925 when the folder cannot be made.
  static SubjectSession begin(const Experiment& experiment, SessionStart start, const std::string& data);
  /// One to go on with: queue and names of files are rebuilt from the log, an interrupted run is marked and comes next.
  /// Throws InputError E926 when experiment, scene or rig are not what the session began with, E936 when a file they name is not.
  static SubjectSession resume(const Experiment& experiment, const SessionFolder& folder);

  enum class End { kComplete, kStopped, kFault };
  /// Runs what is left. kStopped: Ctrl-C; kFault: a device, dynamics or recording failed, see fault(). The trial that was going on is marked
  /// and comes again after resume.
  /// Throws std::system_error when the disk fails, what was logged before stays whole; InputError E928 when trials ask a question that
  /// nobody can answer. `language`: of the texts that are shown.
  End run(Operator& person, const std::string& language);

  const SessionFolder& folder() const noexcept { return folder_; }
  const TrialSource& trials() const noexcept { return *trials_; }
  /// Why run() ended with kFault.
  std::string fault() const { return log_.runs.empty() ? "" : log_.runs.back().end.value("reason", ""); }
  const SessionStart& start() const noexcept { return log_.start; }
  int runsMade() const noexcept { return static_cast<int>(log_.runs.size()); }

 private:
  SubjectSession(const Experiment& experiment, SessionFolder folder, SessionLog log, Journal journal);
  /// Null without a procedure.
  std::unique_ptr<Respondent> respondentFor(Desk& desk) const;
  Conducted conductOne(const PlannedTrial& trial, const LoggedRun& run, Desk& desk, Respondent* respondent) const;
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
