#pragma once
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/scene/scene.h"

/// Helpers for drivers that read the settings a rig gives a device. Thread: main, before a run.
namespace presa {

/// Reports settings that the driver does not know (E401).
void refuseUnknownSettings(const DeviceBinding& binding, const std::vector<std::string>& known,
                           Diagnostics& diagnostics);

/// Reads a setting that must be a positive number (E403); `fallback` when the rig does not give it.
double positiveSetting(const DeviceBinding& binding, const std::string& key, double fallback, Diagnostics& diagnostics);

}  // namespace presa
