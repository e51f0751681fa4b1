#include "framework/scene/decompositions.h"

#include <cstdio>
#include <filesystem>

namespace presa {

std::vector<DecomposedMesh> decompositionsOf(const World& world) {
  std::vector<DecomposedMesh> meshes;
  for (std::size_t i = 0; i < world.scene.bodies.size(); ++i) {
    const Body& body = world.scene.bodies[i];
    const std::vector<ConvexPieces>& decomposed = world.meshes[i].decomposed;
    for (std::size_t k = 0; k < decomposed.size(); ++k) {
      if (decomposed[k].pieces.empty()) continue;
      const auto* compound = std::get_if<Compound>(&body.physics->shape);
      const Shape& shape = compound != nullptr ? compound->parts[k].shape : body.physics->shape;
      meshes.push_back({body.name, std::get<MeshRef>(shape).file, decomposed[k].pieces.size(), decomposed[k].error});
    }
  }
  return meshes;
}

std::string textOf(const DecomposedMesh& mesh) {
  char distance[40];
  std::snprintf(distance, sizeof distance, "%.3f", 1e3 * mesh.error);
  return mesh.body + ": " + std::filesystem::path(mesh.file).filename().string() + " in " +
         std::to_string(mesh.pieces) + " convex piece" + (mesh.pieces == 1 ? "" : "s") + ", Hausdorff distance " +
         distance + " mm";
}

}  // namespace presa
