#pragma once
#include <string>
#include <vector>

#include "apps/temple/building/block.h"

namespace presa::temple {

/// Which blocks of a building a scene holds, and how.
struct SceneSpec {
  struct Stone {
    std::size_t block = 0;  ///< index into Building::blocks
    Pose X_WB;
    bool fixed = false;
  };
  std::string name, description;
  std::vector<Stone> stones;
  bool physics_only = false;  ///< neither seen nor felt
  /// A heap or a façade is one island: with half as many steps as these its stones creep by some 0.1 mm/s.
  bool fine_steps = true;
  bool to_be_built = false;  ///< with an <assembly>: every block is drawn to its place
  AssemblyWords words;       ///< of that assembly; without elements it has none
  double spent = 0;          ///< that people have worked on it before [s]
  std::string rig;           ///< path for the scene's two fingers, thumb and index; empty: no fingers
};

/// Half of the ground's edges along x and y [m]: what strays from a building stays on it.
inline constexpr double kGroundX = 0.6, kGroundY = 0.5;

/// Stones in the order of the spec are bodies in the scene's, before ground and steps. Mesh files are named "meshes/…".
std::string sceneText(const Building& building, const SceneSpec& spec);
/// All blocks where they belong.
SceneSpec assembled(const Building& building);

/// A file of a scene's folder.
struct SceneFile {
  std::string path, text;
};
/// Meshes of all blocks as OBJ; `physics_only`: those alone that dynamics needs.
std::vector<SceneFile> meshFiles(const Building& building, bool physics_only);

}  // namespace presa::temple
