#pragma once
#include <string>
#include <vector>

#include "apps/presa/experiment/session_log.h"

namespace presa::experiment {

/// Every session below a folder (or the folder itself), in order of their paths.
std::vector<SessionFolder> sessionsIn(const std::string& data);

/// What is wrong with one session: files missing, altered or not in the log, trials that are not done. Reads, never writes.
struct Verdict {
  std::vector<std::string> findings;  ///< empty: complete and unaltered
  std::size_t trials = 0;             ///< done and counted
  std::size_t runs = 0;
};
Verdict validate(const SessionFolder& folder);

}  // namespace presa::experiment
