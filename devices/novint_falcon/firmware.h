#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"

namespace presa::falcon {

/// The file that a Falcon's processor runs. Presa may not bring one along (the maker's licence), so the rig names it. Findings
/// go to `diagnostics`: E481..E484, and W485 when it begins as it should but is none of the known files (by SHA-256).
/// Empty when it cannot be used.
std::vector<std::uint8_t> readFirmware(const std::string& file, const SourceLocation& where, Diagnostics& diagnostics);

}  // namespace presa::falcon
