#pragma once
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa::test {

/// A defective mesh as scanners produce it, about 0.1 m large; with adjacency.
struct HardMesh {
  std::string name;
  std::shared_ptr<const TriMesh> mesh;
  bool is_wide = true;  ///< large enough that a wandering point finds it
};
inline std::ostream& operator<<(std::ostream& out, const HardMesh& mesh) { return out << mesh.name; }
std::vector<HardMesh> hardMeshes();

/// Level strips of 10 mm along y, side by side in x, facing +z, with this gap between them [m].
TriMesh strips(double gap, int count);

}  // namespace presa::test
