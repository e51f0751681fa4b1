#pragma once
#include <string>
#include <vector>

#include "framework/core/graph/module.h"
#include "framework/core/schedule/tick.h"
#include "framework/scene/run_options.h"

namespace presa {

/// One plug-in that a run loads, and the reason.
struct PlannedModule {
  std::string plugin;  ///< folder name
  RateGroup group = RateGroup::kHaptic;
  std::string reason;  ///< "body 'cube' is free"
};

struct PlannedDevice {
  std::string role, driver;
  std::vector<std::string> frames;  ///< in which it stands, from the next one to the last before the world
  double zoom = 1;                  ///< largest scale of these frames together
};

/// A plug-in that another one hosts: a force effect in the haptic tick, a part of the picture.
struct PlannedEffect {
  std::string plugin, reason;  ///< "body 'cube' has <magnet>"
};

/// The plug-ins and drivers that a scene needs, and no others. Plain data: nothing is loaded or started yet.
struct Plan {
  std::vector<PlannedModule> modules;
  std::vector<PlannedDevice> devices;  ///< in the order of the scene's roles
  std::vector<PlannedEffect> effects;  ///< each plug-in once
  std::vector<LeftOut> left_out;

  bool has(const std::string& plugin) const;
};

/// Binds every role to a driver of the rig; E405 when one is missing.
std::vector<PlannedDevice> bindDevices(const Scene& scene, const Rig& rig, Diagnostics& diagnostics);
/// Picks the plug-ins of a run with these devices.
Plan makePlan(const Scene& scene, const Rig& rig, std::vector<PlannedDevice> devices, const RunOptions& options,
              Diagnostics& diagnostics);

}  // namespace presa
