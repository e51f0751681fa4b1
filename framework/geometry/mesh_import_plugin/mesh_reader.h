#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace presa {

/// A file's triangles, or why there are none.
struct RawMesh {
  std::string problem;
  std::uint64_t ignored_faces = 0;
  std::vector<double> coordinates;
  std::vector<std::int32_t> indices;
};

/// Reads a mesh file with assimp. May throw, and assimp may crash or run away on a broken file: see isolation.h.
void readMesh(const std::string& file, const std::string& extension, RawMesh& out);

}  // namespace presa
