#pragma once
#include <string>
#include <utility>
#include <vector>

namespace presa {

/// The platform of a cost measurement: processor, kernel, compiler, versions. For the fine print.
std::vector<std::pair<std::string, std::string>> machineFacts();

/// The wall clock, "2026-03-01T09:30:00Z". For display only: the wall clock may jump, so nothing is computed from it.
std::string utcNow();

}  // namespace presa
