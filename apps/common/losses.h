#pragma once
#include <string>
#include <vector>

#include "apps/common/run_result.h"

namespace presa {

/// What a run felt that was not there, or did not feel that was, in whole sentences: ticks in which a fingertip could not see every
/// surface in its reach, and surfaces that a fingertip got past. Empty: nothing of that. Plain text.
std::vector<std::string> lossesOf(const RunResult& result);

}  // namespace presa
