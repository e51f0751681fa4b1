#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "framework/core/diagnostics/diagnostics.h"

namespace presa {

/// {file, kind, valid, findings: [{severity, code, file, line, column, message, help}]} of a checked file; of a scene also
/// its old key `scene`.
nlohmann::json findingsJson(const std::string& file, const std::string& kind, const Diagnostics& diagnostics);

}  // namespace presa
