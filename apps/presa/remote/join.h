#pragma once
#include <optional>

#include "framework/bus/state_bus.h"

namespace presa {

/// The run on the bus; none if there is none within `seconds`, or on Ctrl-C (terminal::Interruption).
std::optional<bus::RunInfo> awaitRun(bus::Reader& reader, double seconds);

}  // namespace presa
