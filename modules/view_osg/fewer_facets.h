#pragma once
#include "framework/geometry/tri_mesh.h"

namespace presa::view {

/// The mesh with fewer triangles in flat and smooth parts; its surface moves by at most about `tolerance` [m]. For
/// software rendering, where small triangles are expensive. Without adjacency.
TriMesh fewerFacets(const TriMesh& mesh, double tolerance);

}  // namespace presa::view
