#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa {

/// Simplifies a mesh to about `triangles` triangles with the plug-in presa_mesh_decimate (meshoptimizer), which is
/// loaded at the first call, while the surface moves by at most about `max_error` [m]. The vertices are a subset of the
/// input's. The result has more triangles than asked for when the topology or the error forbids further collapses; it
/// is the mesh itself where that has no more.
/// Thread: any, not the haptic group. Throws InputError when the plug-in is missing.
TriMesh decimateMesh(const TriMesh& mesh, std::size_t triangles,
                     double max_error = std::numeric_limits<double>::infinity());

/// The corners of a coarser mesh over the same vertices, of which some are left out.
struct CoarserCorners {
  std::vector<std::uint32_t> corners;  ///< three for each triangle
  double error = 0;                    ///< about how far the surface moved [m]
};
/// As decimateMesh, of vertices that may lie in one place with different normals or texture coordinates: such seams
/// stay closed. `places`: x y z of each vertex [m]; `corners`: three for each triangle.
CoarserCorners decimateCorners(const std::vector<float>& places, const std::vector<std::uint32_t>& corners,
                               std::size_t triangles, double max_error = std::numeric_limits<double>::infinity());

/// Symmetric Hausdorff distance of two surfaces [m], sampled at vertices, edge midpoints and triangle centres: a lower
/// bound, exact where the maximum lies at a sample.
double hausdorffDistance(const TriMesh& a, const TriMesh& b);

}  // namespace presa
