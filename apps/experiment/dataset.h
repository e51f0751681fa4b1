#pragma once
#include <string>
#include <vector>

#include "apps/experiment/session_log.h"

namespace presa::experiment {

/// Every session in or below a folder, ordered by path.
std::vector<SessionFolder> sessionsIn(const std::string& data);

/// Validation result of one session.
struct Verdict {
  std::vector<std::string>
      findings;          ///< files missing, changed or not in the log; an unfinished session; empty: no findings
  bool altered = false;  ///< the log or a logged file has changed; unfinished sessions and extra files do not set it
  std::vector<std::string> notes;  ///< trials given up, skipped or excluded, with the reason
  std::size_t trials = 0;          ///< completed trials that count
  std::size_t runs = 0;
  std::string seal;  ///< checksum of the log's last record; a copy kept elsewhere proves the session later
};
Verdict validate(const SessionFolder& folder);

}  // namespace presa::experiment
