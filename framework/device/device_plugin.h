#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "framework/device/device.h"
#include "framework/device/device_rating.h"
#include "framework/plugin/plugin_loader.h"
#include "framework/scene/run_options.h"
#include "framework/scene/world.h"

/// The table that a driver, a plug-in under devices/, exports with PRESA_DEVICE_PLUGIN (see plugin_loader.h).
namespace presa {

/// One result of DevicePlugin::diagnose about a device or the computer; good results are reported, too.
struct DeviceFinding {
  /// How bad it is: nothing to do, something to know, or no use of the device until it is solved.
  enum class Verdict : std::uint8_t { kFine, kWarning, kProblem };
  Verdict verdict = Verdict::kFine;  ///< kFine: good, reported all the same
  int code = 0;                      ///< as in Diagnostic; 0: none
  std::string device;                ///< the device's serial number or port; empty: the computer, or the rig
  std::string message;               ///< one line
  std::string help;                  ///< what to do; may be empty
};

/// Table of a driver, which it exports with PRESA_DEVICE_PLUGIN.
struct DevicePlugin {
  int abi = kPluginAbi;  ///< leave it as it is: another version is refused (E510)
  const char* name;      ///< of its manifest, which lists its settings
  /// Creates a device for each binding, in their order, without touching hardware. Checks their settings (all findings
  /// to `diagnostics`); null for a binding that has an error. createEach<make> is for a driver whose devices do not
  /// know each other. Thread: main.
  DeviceList (*create)(const std::vector<DeviceBinding>& bindings, const std::shared_ptr<const World>& world,
                       const RunOptions& options, Diagnostics& diagnostics);
  /// Looks for its hardware and reports problems; moves nothing. An empty binding means every device of this driver.
  /// Thread: main; may take a second per device. Null: no hardware.
  std::vector<DeviceFinding> (*diagnose)(const DeviceBinding& binding) = nullptr;
  /// Line of a udev rule that lets a user open the hardware; null: none needed.
  const char* udev_rule = nullptr;
  DeviceRating rating = {};  ///< of its hardware, or of the hardware that it models; E655 unless isSound()
  /// True if the driver moves real hardware. In real time it then runs in a process of its own
  /// (framework/device/supervision), where `world` holds only its binding and its role.
  bool hardware = false;
  /// What the user has to do while the device opens, in one sentence; null: nothing.
  const char* while_opening = nullptr;
};

/// DevicePlugin::create with one call of `make` for each binding.
template <auto make>
DeviceList createEach(const std::vector<DeviceBinding>& bindings, const std::shared_ptr<const World>& world,
                      const RunOptions& options, Diagnostics& diagnostics) {
  DeviceList devices;
  for (const DeviceBinding& binding : bindings) {
    if constexpr (std::is_invocable_v<decltype(make), const DeviceBinding&, const World&, Diagnostics&>)
      devices.push_back(make(binding, *world, diagnostics));
    else
      devices.push_back(make(binding, world, options, diagnostics));
  }
  return devices;
}

/// The table of a driver. Loads its plug-in. Throws InputError when it cannot be loaded, or when its rating is not
/// sound (E655).
const DevicePlugin& devicePlugin(const std::string& driver);

}  // namespace presa

/// Exports `table`, a DevicePlugin that lives as long as the library. Once in a plug-in, outside of namespaces.
#define PRESA_DEVICE_PLUGIN(table) \
  extern "C" __attribute__((visibility("default"))) const presa::DevicePlugin* presaDevicePlugin() { return &(table); }
