#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/scene/world.h"
#include "framework/session/plan.h"

namespace presa {

/// What the command line names.
struct Inputs {
  std::string scene;
  std::string rig;                ///< empty: the scene's own
  std::vector<std::string> sets;  ///< PATH=VALUE
};

struct Loaded {
  std::shared_ptr<const World> world;
  Plan plan;
};

/// Scene, overrides, rig, meshes and plan; drivers and their settings are checked too. All findings go to `diagnostics`;
/// the result is usable only when that has no errors.
Loaded loadWorld(const Inputs& inputs, RunOptions options, Diagnostics& diagnostics);

/// Names of the plug-ins that such a run would load. Loads none of them and reads no mesh. Findings as loadWorld.
std::vector<std::string> plugInsFor(const Inputs& inputs, const RunOptions& options, Diagnostics& diagnostics);

/// As loadWorld, from a recording.
Loaded loadWorldFromText(const std::string& scene_xml, const std::string& scene_name, const std::string& rig_xml,
                         RunOptions options, Diagnostics& diagnostics);

}  // namespace presa
