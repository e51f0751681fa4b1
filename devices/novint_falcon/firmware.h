#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"

namespace presa::falcon {

/// Reads the firmware file of a Falcon's processor. The manufacturer's licence does not allow Presa to include it, so
/// the rig names it. Findings go to `diagnostics`: E481..E484, and W485 for a file that begins correctly but is none of
/// the known files (by SHA-256). Empty when it cannot be used.
std::vector<std::uint8_t> readFirmware(const std::string& file, const SourceLocation& where, Diagnostics& diagnostics);

}  // namespace presa::falcon
