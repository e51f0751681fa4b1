#pragma once
#include <string>
#include <vector>

#include "apps/common/run_result.h"

namespace presa {

/// Haptic losses of a run in whole sentences: ticks in which a fingertip missed surfaces in its reach (coverage_lost),
/// and surfaces that a fingertip passed through (pop_through). Empty: none. Plain text.
std::vector<std::string> lossesOf(const RunResult& result);

}  // namespace presa
