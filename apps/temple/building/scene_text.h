#pragma once
#include <string>
#include <vector>

#include "apps/temple/building/block.h"

namespace presa::temple {

/// Contents of a scene: blocks of a building, their poses, and settings.
struct SceneSpec {
  struct Stone {
    std::size_t block = 0;  ///< index into Building::blocks
    Pose X_WB;
    bool fixed = false;
  };
  std::string name, description;
  std::vector<Stone> stones;
  bool painted = false;       ///< in the colours of which traces were found, rather than bare stone
  bool physics_only = false;  ///< physics shapes only, without visual and haptic meshes
  /// More substeps and iterations of the dynamics. A heap or a façade is a single island: with half as many steps its
  /// stones creep by about 0.1 mm/s.
  bool fine_steps = true;
  bool to_be_built = false;  ///< with an <assembly>: every block snaps to its goal
  AssemblyWords words;       ///< texts of that assembly; without elements: no texts
  double elapsed = 0;        ///< elapsed assembly time carried over [s]
  std::string rig;           ///< path of the rig for the scene's two fingers, thumb and index; empty: no fingers
};

/// Half the edges of the ground along x and y [m].
inline constexpr double kGroundX = 0.6, kGroundY = 0.5;

/// Text of the scene file. The scene's first bodies are the stones in the order of `spec`; ground and steps follow.
/// Mesh files are named "meshes/…".
std::string sceneText(const Building& building, const SceneSpec& spec);
/// All blocks at their goal poses.
SceneSpec assembled(const Building& building);

/// A file of a scene's folder.
struct SceneFile {
  std::string path, text;
};
/// Meshes of all blocks as OBJ; `physics_only`: only the meshes that the dynamics needs.
std::vector<SceneFile> meshFiles(const Building& building, bool physics_only);

}  // namespace presa::temple
