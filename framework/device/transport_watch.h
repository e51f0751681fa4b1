#pragma once
#include <memory>

#include "framework/core/schedule/executor.h"
#include "framework/device/device.h"
#include "framework/device/output_limits.h"

namespace presa {

/// Between the output stage and a device, in tests: looks at every force that is sent, with eyes of its own, and ends the process with a
/// message when one is not finite, above the limit, further from the one before than the slew limit allows, not zero before the
/// first usable sample, or not zero 20 ms after the device was lost. Whatever `limits` became of scene and rig, `rating` holds. `./dev test` puts it before every device of every test
/// (PRESA_WATCH_TRANSPORT); otherwise the device is returned as it is. Thread: haptic; nonblocking.
std::unique_ptr<Device> watched(std::unique_ptr<Device> device, const OutputLimits& limits, const DeviceRating& rating,
                                const RunControl& control);

}  // namespace presa
