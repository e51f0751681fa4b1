#pragma once
#include <string>
#include <vector>

#include "apps/experiment/session_log.h"

namespace presa::experiment {

/// A column of a session's trial table, from trials.csv and trials.json.
struct SourceColumn {
  std::string name, unit, description;
};

/// Everything of one session that an export is made from. Nothing is taken from the experiment's own files: they may have
/// changed, or be on another machine.
struct SourceSession {
  SessionFolder folder;
  SessionLog log;
  Json start, end{};  ///< first record of the log; the last, null while the session is not finished
  std::string seal;   ///< sum of the log's last record
  std::string title{}, description{}, instructions{};  ///< from the experiment as it was read
  std::vector<SourceColumn> columns{};                 ///< of the trial table
  std::vector<std::vector<std::string>> rows{};        ///< one for each of log.runs, cells as written

  /// "sub-S01_ses-1"
  std::string prefix() const;
  std::string model() const { return start.value("model", ""); }
  std::string name() const { return start.at("experiment"); }
  /// Recordings of a run that ended, in the order in which they were made.
  std::vector<std::string> recordings(const LoggedRun& run) const;
};

/// A run of which the log holds an end that is not an interruption, and its recordings are on disk.
bool ended(const LoggedRun& run);

/// Throws InputError E931 when a file of the session is missing, or not what the log says.
void checkUnaltered(const SessionFolder& folder, const std::string& name, const std::string& sum);

/// All sessions below a folder that have a trial to export. Throws InputError: E930 there is none; E931 one is damaged or was
/// altered; E932 two of them would get the same names.
std::vector<SourceSession> sourceSessions(const std::string& data);

}  // namespace presa::experiment
