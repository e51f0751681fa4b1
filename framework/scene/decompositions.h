#pragma once
#include <string>
#include <vector>

#include "framework/scene/world.h"

namespace presa {

/// A physics mesh that was cut into convex pieces.
struct DecomposedMesh {
  std::string body,        ///< name of the body
      file;                ///< as MeshRef::file
  std::size_t pieces = 0;  ///< number of convex pieces
  double error = 0;        ///< Hausdorff distance between the mesh and the union of its pieces, as solids [m]
};

/// Of all bodies, in scene order. Thread: any.
std::vector<DecomposedMesh> decompositionsOf(const World& world);
/// "cup: cup.obj in 25 convex pieces, Hausdorff distance 0.000 mm".
std::string textOf(const DecomposedMesh& mesh);

}  // namespace presa
