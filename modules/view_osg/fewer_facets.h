#pragma once
#include "framework/geometry/tri_mesh.h"

namespace presa::view {

/// The mesh with fewer triangles where flat parts, edges and bends leave them without a say: its surface moves by about `tolerance` [m] at
/// most. For a processor that draws: small triangles are dear to it. Without adjacency.
TriMesh fewerFacets(const TriMesh& mesh, double tolerance);

}  // namespace presa::view
