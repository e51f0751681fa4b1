#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/scene/world.h"
#include "framework/session/plan.h"

namespace presa {

/// Files and overrides that the command line names.
struct Inputs {
  std::string scene;
  std::string rig;                ///< empty: the rig that the scene names
  std::vector<std::string> sets;  ///< PATH=VALUE
};

struct Loaded {
  std::shared_ptr<const World> world;
  Plan plan;
};

/// Reads scene, overrides, rig and meshes and makes the plan; checks drivers and their settings, too. All findings go
/// to `diagnostics`; the result is usable only if it has no errors. Thread: main.
Loaded loadWorld(const Inputs& inputs, RunOptions options, Diagnostics& diagnostics);

/// Names of the plug-ins that a run of these inputs would load. Loads no plug-in, reads no mesh. Findings as loadWorld.
std::vector<std::string> plugInsFor(const Inputs& inputs, const RunOptions& options, Diagnostics& diagnostics);

/// As loadWorld, from the texts of a recording.
Loaded loadWorldFromText(const std::string& scene_xml, const std::string& scene_name, const std::string& rig_xml,
                         RunOptions options, Diagnostics& diagnostics);

}  // namespace presa
