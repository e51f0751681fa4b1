#pragma once
#include <string>
#include <vector>

#include "apps/common/run_result.h"

namespace presa {

/// A run in a few sentences, the same in report and terminal. Plain text, no markup.
struct Verdict {
  enum class Outcome { kGood, kNeutral, kBad };
  Outcome outcome = Outcome::kNeutral;
  std::string headline;               ///< "cube lifted by 98.7 mm, held in stick for 3.00 s"
  std::vector<std::string> details;   ///< whole sentences
  std::vector<std::string> warnings;  ///< losses (losses.h); a good run has none
};

Verdict verdictOf(const RunResult& result);

}  // namespace presa
