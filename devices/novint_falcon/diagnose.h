#pragma once
#include <vector>

#include "framework/device/device_plugin.h"

namespace presa::falcon {

/// Finds every connected Falcon, the reasons why one cannot be used, and errors in the binding's settings. Waits up to
/// five seconds per device; sends no force, loads no firmware.
std::vector<DeviceFinding> diagnose(const DeviceBinding& binding);

}  // namespace presa::falcon
