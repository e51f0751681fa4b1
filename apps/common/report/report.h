#pragma once
#include <string>

#include "apps/common/run_result.h"

namespace presa {

/// The run as one self-contained HTML page: styles, plots, script and screenshot are inside it, and its content
/// policy forbids every request. A screenshot that cannot be read is mentioned in the notes.
std::string reportHtml(const RunResult& result);

/// Writes it atomically. Throws std::system_error when the file cannot be written.
void writeReport(const RunResult& result, const std::string& path);

}  // namespace presa
