#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa::test {

/// A mesh that no modeller should make and every scanner does, about 0.1 m; with adjacency.
struct HardMesh {
  std::string name;
  std::shared_ptr<const TriMesh> mesh;
};
std::vector<HardMesh> hardMeshes();

/// Level strips of 10 mm along y, side by side in x, facing +z, with gaps of this width between them.
TriMesh strips(double gap, int count);

}  // namespace presa::test
