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

/// The same from a recording.
Loaded loadWorldFromText(const std::string& scene_xml, const std::string& scene_name, const std::string& rig_xml,
                         RunOptions options, Diagnostics& diagnostics);

}  // namespace presa
