#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/device/device.h"
#include "framework/scene/run_options.h"
#include "framework/scene/world.h"
#include "framework/session/plan.h"

namespace presa {

inline constexpr double kDefaultDuration = 10;  ///< of a run whose devices have no script [s]

/// Files and overrides that the command line names.
struct Inputs {
  std::string scene;
  std::string rig;                ///< empty: the rig that the scene names
  std::vector<std::string> sets;  ///< PATH=VALUE
  /// A scene or rig in no file; empty: it stands in the file. `scene` is then its name in messages, and paths resolve
  /// against the working directory.
  std::string scene_xml{}, rig_xml{};
};

/// A run that is checked and can start.
struct Loaded {
  std::shared_ptr<const World> world;
  RunOptions options;  ///< as they hold: with a duration, and with the bus of scene and rig
  Plan plan;
  DeviceList devices;  ///< of the rig, as Plan::devices; checked, not open
};

/// Reads scene, overrides, rig and meshes, makes the plan and the devices. A duration of 0 becomes that of the devices'
/// script, or kDefaultDuration. All findings go to `diagnostics`; the result is usable only if it has no errors.
/// Thread: main.
Loaded loadWorld(const Inputs& inputs, RunOptions options, Diagnostics& diagnostics);

/// Names of the plug-ins that a run of these inputs would load. Loads no plug-in, reads no mesh. Findings as loadWorld.
std::vector<std::string> plugInsFor(const Inputs& inputs, const RunOptions& options, Diagnostics& diagnostics);

/// A scene and its rig as texts. `name`: of the scene in messages.
struct RunTexts {
  std::string scene_xml, name, rig_xml;
};

/// As loadWorld, from texts.
Loaded loadWorldFromText(const RunTexts& texts, RunOptions options, Diagnostics& diagnostics);
/// As loadWorldFromText, for a caller that brings devices: those of the rig are not made, nor their drivers needed.
Loaded loadWithoutDevices(const RunTexts& texts, RunOptions options, Diagnostics& diagnostics);

}  // namespace presa
