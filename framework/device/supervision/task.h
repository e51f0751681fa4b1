#pragma once
#include <string>
#include <string_view>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/scene/scene.h"

namespace presa {

/// The device that a supervisor is to open. `packed` and `unpacked…` carry it, and the answers, as text between two
/// processes of the same build.
struct SupervisorTask {
  DeviceBinding binding;  ///< role, driver, settings and their places; frame and limits are not carried
  std::string rig_file;   ///< for messages
};

std::string packed(const SupervisorTask& task);      ///< fields, each ended by a zero byte
SupervisorTask unpackedTask(std::string_view text);  ///< of packed() only: unchecked

std::string packed(const Diagnostics& findings);      ///< those kept, see Diagnostics
Diagnostics unpackedFindings(std::string_view text);  ///< of packed() only: unchecked

std::string packed(const std::vector<std::string>& lines);      ///< a line is cut at a zero byte
std::vector<std::string> unpackedLines(std::string_view text);  ///< of packed() only: unchecked

}  // namespace presa
