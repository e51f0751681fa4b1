#pragma once
#include <memory>

#include "framework/device/device.h"
#include "framework/device/output_limits.h"

namespace presa {

/// Test probe between the output stage and a device. Checks the force and the torque of every wrench that is sent and
/// aborts the process with a message when one is not finite, above the limit, changed faster than the slew limit, not
/// zero before the first usable sample, not zero right after a gap (Tick::resumed), or not zero 20 ms after the device
/// was lost (until Device::rearm). The smaller of `limits` and `rating` holds, so that a wrong `limits` cannot hide a
/// fault. `./dev test` puts the probe in front of every device of every test (environment variable
/// PRESA_WATCH_TRANSPORT); otherwise `device` is returned as it is.
/// Thread: haptic; nonblocking.
std::unique_ptr<Device> watched(std::unique_ptr<Device> device, const OutputLimits& limits, const DeviceRating& rating);

}  // namespace presa
