#pragma once
#include <string>
#include <vector>

#include "framework/scene/scene.h"

namespace presa {

/// `PATH=VALUE` from the command line. The path walks the tree by names:
///   body/cube/physics/mass   material/rubber/friction/static   rates/dynamics   device/thumb/limits/force
struct Override {
  std::string path;
  std::string value;
};

/// Reads, overrides, validates (XSD, references, ranges) and resolves a scene file. All findings go to
/// `diagnostics`; the result is meaningful only when that has no errors. Reads no mesh. Never throws for bad input.
Scene loadScene(const std::string& file, const std::vector<Override>& overrides, Diagnostics& diagnostics);
/// The same from memory; `name` stands for the file in messages, relative paths resolve against `directory`.
Scene parseScene(const std::string& xml, const std::string& name, const std::string& directory,
                 const std::vector<Override>& overrides, Diagnostics& diagnostics);
Rig loadRig(const std::string& file, Diagnostics& diagnostics);
Rig parseRig(const std::string& xml, const std::string& name, const std::string& directory, Diagnostics& diagnostics);

/// Files that they name, as resolved: meshes; settings that are paths.
std::vector<std::string> filesNamedBy(const Scene& scene);
std::vector<std::string> filesNamedBy(const Rig& rig);

}  // namespace presa
