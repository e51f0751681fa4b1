#pragma once
#include <optional>

#include "framework/bus/state_bus.h"

namespace presa {

/// The run that is on the bus; none within `seconds`, or on Ctrl-C (terminal::Interruption).
std::optional<bus::RunInfo> awaitRun(bus::Reader& reader, double seconds);

}  // namespace presa
