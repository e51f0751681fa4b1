#pragma once
#include <string>

#include "apps/common/run_result.h"

namespace presa {

/// The run as JSON, for scripts: keys end in their unit, absent values are null, numbers round-trip exactly.
std::string summaryJson(const RunResult& result);

/// Writes it atomically. Throws std::system_error when the file cannot be written.
void writeSummary(const RunResult& result, const std::string& path);

/// "0x0123456789abcdef"
std::string hashText(std::uint64_t hash);

}  // namespace presa
