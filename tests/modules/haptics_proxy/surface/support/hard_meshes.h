#pragma once
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa::test {

/// A mesh that no modeller should make and every scanner does, about 0.1 m; with adjacency.
struct HardMesh {
  std::string name;
  std::shared_ptr<const TriMesh> mesh;
  bool is_wide = true;  ///< a wandering point finds it; else it may go between
};
inline std::ostream& operator<<(std::ostream& out, const HardMesh& mesh) { return out << mesh.name; }
std::vector<HardMesh> hardMeshes();

/// Level strips of 10 mm along y, side by side in x, facing +z, with gaps of this width between them.
TriMesh strips(double gap, int count);

}  // namespace presa::test
