#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace presa {

/// A file's triangles, or why there are none.
struct RawMesh {
  struct Problem {
    std::int32_t code = 0;  ///< of framework/input; 0: of the mesh itself
    std::string what, help;
  };
  std::string problem, help;
  std::int32_t code = 0;
  std::uint64_t ignored_faces = 0;
  std::vector<double> coordinates;
  std::vector<std::int32_t> indices;
};

/// Reads a mesh file with assimp. May throw, and assimp may crash or run away on a broken file: see isolation.h.
void readMesh(const std::string& file, const std::string& extension, RawMesh& out);

}  // namespace presa
