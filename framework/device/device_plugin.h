#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/plugin/plugin_loader.h"
#include "framework/device/device.h"
#include "framework/device/device_rating.h"
#include "framework/scene/world.h"

/// The table of a driver, a plug-in under devices/ (see plugin_loader.h).
namespace presa {

/// What a driver finds when it is asked how its devices are: one line each, good news too.
struct DeviceFinding {
  enum class Verdict : std::uint8_t { kFine, kWarning, kProblem };
  Verdict verdict = Verdict::kFine;
  int code = 0;         ///< as in Diagnostic; 0: none
  std::string device;   ///< which one: a serial number, a port; empty: the computer, or the rig
  std::string message;  ///< one line
  std::string help;     ///< what to do; may be empty
};

struct DevicePlugin {
  int abi = kPluginAbi;
  const char* name;
  const char* summary;
  /// Checks binding.settings (all findings to `diagnostics`); null when something is wrong.
  std::unique_ptr<Device> (*create)(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics);
  /// Looks for its hardware and at what may be wrong with it; moves nothing. The binding may be empty: then at every device.
  /// Thread: main; may take a second a device. Null: no hardware.
  std::vector<DeviceFinding> (*diagnose)(const DeviceBinding& binding) = nullptr;
  /// The line of a udev rule that lets a user open its hardware; null: none needed.
  const char* udev_rule = nullptr;
  DeviceRating rating = {};  ///< of its hardware, or of the hardware that it models; unsound: E655
  /// Moves something real: in real time it lives in a process of its own (framework/device/supervision), with a world that holds its binding
  /// and its role, and nothing else.
  bool hardware = false;
  /// What somebody has to do while it opens, in one sentence; null: nothing.
  const char* while_opening = nullptr;
};

/// The table of a driver. Loads its plug-in; throws InputError when that cannot be done.
const DevicePlugin& devicePlugin(const std::string& driver);

}  // namespace presa

#define PRESA_DEVICE_PLUGIN(table) \
  extern "C" __attribute__((visibility("default"))) const presa::DevicePlugin* presaDevicePlugin() { return &(table); }
