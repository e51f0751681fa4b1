#pragma once
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/common/terminal_run.h"
#include "framework/device/device_plugin.h"
#include "tests/support/alloc_lock_guard.h"

/// A shipped scene with a shipped rig, for the tests of the rig's devices.
namespace presa::test {

/// Runs the scene in lockstep to the end of its script.
inline std::unique_ptr<TerminalRun> runToTheEnd(const std::string& scene, const std::string& rig,
                                                const std::vector<std::string>& sets = {}) {
  Diagnostics diagnostics;
  RunOptions options;
  options.duration = 0;
  Loaded loaded = loadWorld({scene, rig, sets}, options, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  auto run = std::make_unique<TerminalRun>(std::move(loaded),
                                           TerminalRun::Settings{.trace_rate = 1000, .quiet = true, .command = ""});
  run->execute();
  return run;
}

/// The device of the rig's first role after `change`; null, with findings, when it is refused.
inline std::unique_ptr<Device> firstDevice(
    const std::string& scene, const std::string& rig, Diagnostics& diagnostics,
    const std::function<void(DeviceBinding&)>& change = [](DeviceBinding&) {}) {
  const Loaded loaded = loadWorld({scene, rig, {}}, {}, diagnostics);
  DeviceBinding binding = loaded.world->rig.devices.at(0);
  change(binding);
  return std::move(devicePlugin(binding.driver).create({binding}, loaded.world, {}, diagnostics).at(0));
}

/// Expects three seconds of ticks with varying forces to be free of real-time violations.
inline void expectRealTime(Device& device) {
  const RealTimeGuard guard;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Tick tick{i, static_cast<double>(i) * 1e-3, 1e-3};
    device.read(tick);
    device.write(Vec3(0.1, 0, 20.0 * static_cast<double>(i % 2)), tick);
  }
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

}  // namespace presa::test
