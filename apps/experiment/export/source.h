#pragma once
#include <string>
#include <vector>

#include "apps/experiment/session_log.h"

namespace presa::experiment {

/// A column of a session's trial table, from trials.csv and trials.json.
struct SourceColumn {
  std::string name, unit, description;
};

/// Everything of one session that an export needs. The experiment's own files are not read: they may have changed, or
/// be on another machine.
struct SourceSession {
  SessionFolder folder;
  SessionLog log;
  Json start, end{};  ///< first and last record of the log; `end` is null while the session is unfinished
  std::string seal;   ///< checksum of the log's last record
  std::string title{}, description{}, instructions{};  ///< from the session's copy of the experiment
  std::vector<SourceColumn> columns{};                 ///< columns of the trial table
  std::vector<std::vector<std::string>> rows{};        ///< one row for each of log.runs, cells as written

  /// Prefix of file names, such as "sub-S01_ses-1".
  std::string prefix() const;
  std::string model() const { return start.value("model", ""); }
  std::string name() const { return start.at("experiment"); }
  /// Recordings of a run that ended, in the order in which they were made.
  std::vector<std::string> recordings(const LoggedRun& run) const;
};

/// True when the log holds the end of the run, the run was not interrupted, and its recordings are on disk.
bool ended(const LoggedRun& run);

/// Throws InputError E931 when a file of the session is missing, or its SHA-256 differs from `sum`.
void checkUnaltered(const SessionFolder& folder, const std::string& name, const std::string& sum);

/// All sessions below a folder that have a trial to export. Throws InputError: E930 no session; E931 a session is
/// damaged or was altered; E932 two sessions would get the same file names.
std::vector<SourceSession> sourceSessions(const std::string& data);

}  // namespace presa::experiment
