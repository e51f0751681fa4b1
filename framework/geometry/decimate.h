#pragma once
#include <cstddef>

#include "framework/geometry/tri_mesh.h"

namespace presa {

/// The same shape with about `triangles` triangles, through the plug-in presa_mesh_decimate (meshoptimizer), which is loaded
/// at the first call. Its vertices are some of the mesh's; it may keep more triangles when the topology asks for them.
/// Thread: any, not the haptic group. Throws InputError when the plug-in is missing.
TriMesh decimateMesh(const TriMesh& mesh, std::size_t triangles);

/// Largest distance of a point of either surface from the other [m]: at vertices, edge middles and centres of triangles
/// (a lower bound of the Hausdorff distance, exact where it lies at one of these).
double hausdorffDistance(const TriMesh& a, const TriMesh& b);

}  // namespace presa
