#pragma once
#include <string>
#include <vector>

#include "apps/experiment/journal.h"
#include "apps/experiment/subject.h"
#include "experiments/runner/definition/trial_source.h"

namespace presa::experiment {

/// The folder of a session: DIR/sub-ID/ses-N, with
///   journal.jsonl                     the write-ahead log; trials.csv and trials.json follow from it
///   trials.csv, trials.json           one row per run of a trial; the meaning of the columns
///   experiment.xml scene.xml rig.xml  the files as read, with all defaults filled in
///   trial-007_run-1.h5                every haptic tick of one run
///   trial-007_run-1_interval-2.h5     its second interval, in trials of two intervals
struct SessionFolder {
  std::string path;
  std::string file(const std::string& name) const { return path + "/" + name; }
  std::string journal() const { return file(kJournal); }
  /// Path of a file that the log names relative to the folder; empty stays empty.
  std::string named(const std::string& relative) const;
  /// File names of the recordings of one run of a trial.
  static std::vector<std::string> filesOf(const PlannedTrial& trial, int run, std::size_t presentations);
};
SessionFolder folderOf(const std::string& data, const std::string& subject, int session);

/// The settings of a session, from the first record of its log.
struct SessionStart {
  std::string experiment_file{}, rig_file{};  ///< relative to the session's folder in the log: see SessionFolder::named
  Subject subject{};
  int session = 1;
  bool realtime = false;
  std::string simulated{};  ///< requested level of the simulated subject; empty: a person, or the rig's own level
  /// The model that held the devices, such as "simulated subject, level L1: a model, not a person"; empty for a person.
  /// Every output with numbers of this session must show it.
  std::string model{};
  std::uint64_t seed = 0;  ///< the experiment's seed, or the one requested instead
  bool recording = true;   ///< every haptic tick is recorded
  bool window = false;     ///< the participant sees the scene in a window
};
Json toJson(const SessionStart& start);

/// One run of a trial, as logged.
struct LoggedRun {
  int number = 0, attempt = 1, run = 1;
  bool practice = false;
  Outcome outcome = Outcome::kInterrupted;
  Json begin, end;  ///< its records; `end` is null when the process died during the run

  /// The answer; no value where no question was asked or nobody answered.
  std::optional<psychophysics::Response> response() const;
  /// Recordings of the run, one per presentation, in order; some do not exist when the run ended early.
  std::vector<std::string> files() const { return begin.at("files").get<std::vector<std::string>>(); }
};

/// A parsed log.
struct SessionLog {
  SessionStart start;
  std::vector<LoggedRun> runs;
  bool complete = false;  ///< the last trial is done
};

/// Throws InputError E924 when the log is not that of a session, or has a newer format.
SessionLog readLog(const std::string& file, const std::vector<Json>& records);

const char* toString(Outcome outcome);

}  // namespace presa::experiment
