#pragma once
#include <string>
#include <vector>

#include "framework/scene/scene.h"

namespace presa {

/// `PATH=VALUE` from the command line. The path names elements from the root down and ends with an attribute:
///   body/cube/physics/mass   material/rubber/friction/static   rates/dynamics   device/thumb/limits/force
struct Override {
  std::string path;   ///< from the root down, without the root itself
  std::string value;  ///< text of the attribute's new value
};

/// Reads a scene file, applies the overrides, validates (XSD, references, ranges) and resolves it. All findings go to
/// `diagnostics`; the result is valid only when there are no errors. Reads no mesh. Never throws for bad input.
Scene loadScene(const std::string& file, const std::vector<Override>& overrides, Diagnostics& diagnostics);
/// As loadScene, from memory. Messages call the file `name`; relative paths resolve against `directory`.
Scene parseScene(const std::string& xml, const std::string& name, const std::string& directory,
                 const std::vector<Override>& overrides, Diagnostics& diagnostics);
Rig loadRig(const std::string& file, Diagnostics& diagnostics);  ///< as loadScene, of a rig: no overrides
/// As parseScene, of a rig.
Rig parseRig(const std::string& xml, const std::string& name, const std::string& directory, Diagnostics& diagnostics);

/// Resolved paths of the files that a scene or rig refers to: meshes, and device settings that are paths.
std::vector<std::string> filesNamedBy(const Scene& scene);
std::vector<std::string> filesNamedBy(const Rig& rig);  ///< resolved paths

}  // namespace presa
