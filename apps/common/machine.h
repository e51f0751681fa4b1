#pragma once
#include <string>
#include <utility>
#include <vector>

namespace presa {

/// What a cost depends on beside the settings: processor, kernel, compiler, versions. For the fine print.
std::vector<std::pair<std::string, std::string>> machineFacts();

/// The wall clock, "2026-03-01T09:30:00Z". For people only: nothing is computed from it, so that a clock that jumps does no harm.
std::string utcNow();

}  // namespace presa
