#pragma once
#include <string>
#include <vector>

#include "apps/experiment/session_log.h"

namespace presa::experiment {

/// Every session below a folder (or the folder itself), in order of their paths.
std::vector<SessionFolder> sessionsIn(const std::string& data);

/// What is to be said of one session. Reads, never writes.
struct Verdict {
  std::vector<std::string>
      findings;          ///< files missing, changed or not in the log, a session not finished; empty: in order
  bool altered = false;  ///< a file or the log is not what was written: not merely unfinished, or with a stranger
  std::vector<std::string> notes;  ///< what the data itself tells: trials given up, skipped, excluded and why
  std::size_t trials = 0;          ///< done and counted
  std::size_t runs = 0;
  std::string seal;  ///< sum of the log's last record: noted elsewhere, it proves the session later
};
Verdict validate(const SessionFolder& folder);

}  // namespace presa::experiment
