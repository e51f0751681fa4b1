#pragma once
#include <string>
#include <vector>

#include "framework/geometry/tri_mesh.h"
#include "framework/scene/scene.h"

namespace presa::temple {

enum class BlockKind {
  kDrum,
  kCapital,
  kArchitrave,
  kTriglyph,
  kMetope,
  kCornice,
  kTympanum,
  kRakingCornice,
  kTile,
};

/// One stone of the building, in its own frame B: the centre of its physics shape, z up where it stands.
struct Block {
  std::string name;
  BlockKind kind = BlockKind::kDrum;
  Pose X_WB;             ///< where it belongs
  int fold = 1;          ///< in so many turns about z it fits as well
  double mass = 0;       ///< [kg]
  TriMesh visual;        ///< fine
  TriMesh haptic;        ///< flutes, dowel holes and chips, with fewer facets
  Shape physics;         ///< encloses both, and shares their bearing faces; MeshRef: `physics_mesh`
  TriMesh physics_mesh;  ///< convex; empty where a primitive serves
};

/// Something that does not move: the steps the building stands on.
struct Footing {
  std::string name;
  Pose X_WB;
  Vec3 size = Vec3::Zero();  ///< [m]
};

struct Building {
  std::string name;
  std::vector<Block> blocks;  ///< in an order in which it can be built
  std::vector<Footing> footings;
  double top = 0;  ///< highest point above the ground [m]
};

}  // namespace presa::temple
