#pragma once
#include <vector>

#include "framework/device/device_plugin.h"

namespace presa::falcon {

/// Every Falcon that is plugged in, what keeps each from being used, and what the binding's settings have wrong. Waits up to
/// a second a device; sends no force, loads no firmware.
std::vector<DeviceFinding> diagnose(const DeviceBinding& binding);

}  // namespace presa::falcon
