#pragma once
#include <optional>
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

/// A photographed model in place of Block::visual (apps/temple/models).
struct BlockModel {
  std::string file;           ///< absolute path
  Vec3 scale = Vec3::Ones();  ///< of its axes, to metres
  Vec3 p_BM = Vec3::Zero();   ///< its origin in the block's frame [m]
};

/// One stone of the building. Its frame B is at the centre of its physics shape, z up in the finished building.
struct Block {
  std::string name;
  BlockKind kind = BlockKind::kDrum;
  Pose X_WB;             ///< goal pose in the building
  int fold = 1;          ///< order of rotational symmetry about z
  double mass = 0;       ///< [kg]
  TriMesh visual;        ///< fine mesh
  TriMesh haptic;        ///< flutes, dowel holes and chips, with fewer facets
  Shape physics;         ///< encloses both and shares their bearing faces; a MeshRef stands for `physics_mesh`
  TriMesh physics_mesh;  ///< convex; empty when `physics` is a primitive
  /// A convex part of the physics geometry.
  struct Part {
    Shape shape;     ///< Box, Cylinder, or a MeshRef that stands for `mesh`
    Vec3 p_BG;       ///< its place [m]
    TriMesh mesh{};  ///< convex; empty for a primitive
  };
  std::vector<Part> parts;  ///< of a block with a tenon or a mortise, in place of `physics`, out of which a tenon juts
  double tenon = 0;         ///< how far the tenon juts out below [m]; 0: none
  std::optional<BlockModel> model;
};

/// A fixed box: a step that the building stands on.
struct Footing {
  std::string name;
  Pose X_WB;
  Vec3 size = Vec3::Zero();  ///< [m]
};

/// A person at the building's scale, only to be seen. Its frame B is on the ground between the feet, z up, facing -y.
struct Figure {
  TriMesh mesh;
  Pose X_WB;
  double height = 0;  ///< [m]
};

struct Building {
  std::string name;
  std::vector<Block> blocks;  ///< in an order in which it can be built
  std::vector<Footing> footings;
  std::optional<Figure> figure;
  bool upright = false;  ///< Proportions::upright
  double top = 0;        ///< highest point above the ground [m]
};

}  // namespace presa::temple
