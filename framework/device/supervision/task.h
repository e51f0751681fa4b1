#pragma once
#include <string>
#include <string_view>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/scene/scene.h"

namespace presa {

/// The device that a supervisor is to open. `packed` and `unpacked…` carry it, and the answers, as text between two
/// processes of the same build.
struct SupervisorTask {
  DeviceBinding binding;
  std::string rig_file;
};

std::string packed(const SupervisorTask& task);
SupervisorTask unpackedTask(std::string_view text);

std::string packed(const Diagnostics& findings);
Diagnostics unpackedFindings(std::string_view text);

std::string packed(const std::vector<std::string>& lines);
std::vector<std::string> unpackedLines(std::string_view text);

}  // namespace presa
