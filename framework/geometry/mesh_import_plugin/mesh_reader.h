#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "framework/geometry/mesh_import_abi.h"

namespace presa {

/// What a file says about colours; as ImportedModel.
struct RawModel {
  std::vector<float> vertices;
  std::vector<std::uint32_t> corners;
  std::vector<ImportedPart> parts;
  std::vector<ImportedMaterial> materials;
  std::vector<ImportedTexture> textures;
  std::string text, missing_library;
};

/// As ImportedAttributes.
struct RawAttributes {
  std::string names;  ///< each ended by a zero
  std::vector<std::int32_t> part_of;
  std::vector<float> grey;
};

/// The triangles of a file, or the reason why it could not be read (`problem` is not empty).
struct RawMesh {
  struct Problem {
    std::int32_t code = 0;  ///< error number of framework/input; 0: the mesh itself is bad
    std::string what, help;
  };
  std::string problem, help;
  std::int32_t code = 0;
  std::uint64_t ignored_faces = 0;
  std::vector<double> coordinates;
  std::vector<std::int32_t> indices;
  RawModel model;
  RawAttributes attributes;
};

/// Reads a mesh file with assimp. May throw; assimp may crash or not terminate on a damaged
/// file, see isolation.h.
void readMesh(const std::string& file, const std::string& extension, MeshWanted wanted, RawMesh& out);

}  // namespace presa
