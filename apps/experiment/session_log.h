#pragma once
#include <string>
#include <vector>

#include "apps/experiment/journal.h"
#include "apps/experiment/subject.h"
#include "experiments/runner/definition/trial_source.h"

namespace presa::experiment {

/// The folder of a session: DIR/sub-ID/ses-N, with
///   journal.jsonl                     the write-ahead log, from which everything else can be told
///   trials.csv, trials.json           one row per run of a trial; what the columns mean
///   experiment.xml scene.xml rig.xml  as they were read, with every default
///   trial-007_run-1.h5                every haptic tick of one run (trial-007_run-1_interval-2.h5: of its second interval)
struct SessionFolder {
  std::string path;
  std::string file(const std::string& name) const { return path + "/" + name; }
  std::string journal() const { return file("journal.jsonl"); }
  /// A file that the log names; empty stays empty.
  std::string named(const std::string& relative) const;
  /// Of the recordings of one run of a trial.
  static std::vector<std::string> filesOf(const PlannedTrial& trial, int run, std::size_t presentations);
};
SessionFolder folderOf(const std::string& data, const std::string& subject, int session);

/// What a session was started with, from the first record of its log.
struct SessionStart {
  std::string experiment_file{}, rig_file{};  ///< in the log from the session's folder on: see SessionFolder::named
  Subject subject{};
  int session = 1;
  bool realtime = false;
  std::string simulated{};  ///< level of the simulated subject that was asked for; empty: none was, or the rig's own
  /// What held the devices if no person did: "simulated subject, level L1: a model, not a person". Whatever shows numbers of
  /// this session says so.
  std::string model{};
  std::uint64_t seed = 0;  ///< of the experiment: its own, or another one that was asked for
  bool recording = true;   ///< every haptic tick is kept
  bool window = false;     ///< the participant sees the scene in a window
};
Json toJson(const SessionStart& start);

/// One run of a trial, as the log has it.
struct LoggedRun {
  int number = 0, attempt = 1, run = 1;
  bool practice = false;
  Outcome outcome = Outcome::kInterrupted;
  Json begin, end;  ///< its records; `end` is null when the process died in it

  /// The answer; none where nothing was asked or nobody answered.
  std::optional<psychophysics::Response> response() const;
  /// Recordings of the run, one for each presentation, in their order; not all are there when it ended early.
  std::vector<std::string> files() const { return begin.at("files").get<std::vector<std::string>>(); }
};

/// A log taken apart.
struct SessionLog {
  SessionStart start;
  std::vector<LoggedRun> runs;
  bool complete = false;  ///< the last trial is done
};

/// E924: the log is not one of a session, or of a newer format.
SessionLog readLog(const std::string& file, const std::vector<Json>& records);

const char* toString(Outcome outcome);

}  // namespace presa::experiment
