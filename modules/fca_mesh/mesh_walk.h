#pragma once
#include <cstdint>

#include "framework/geometry/tri_mesh.h"

namespace presa::fca {

/// Where a point of a triangle lies: inside (neither), on one edge, or at a corner.
struct Feature {
  int edge = -1;    ///< edge i leads from corner i to the next
  int corner = -1;  ///< set: the point lies there, whatever `edge` is
};

/// A point of a mesh's surface, in mesh coordinates.
struct SurfacePoint {
  std::int32_t triangle = -1;
  Vec3 q = Vec3::Zero();
  Feature feature;  ///< of the triangle
};

/// Walks over the mesh from a triangle towards g: across edges while the foot of g on the triangle's plane lies beyond;
/// then from the point of the triangle nearest to g, across the edge or around the vertex where that lies, to whichever
/// neighbour is nearer, until none is. The way never leaves the surface. A crossed edge leads to a half-plane nearer to g,
/// each later step to a nearer point; the end is a local minimum. At most kMaxSteps triangles each; needs
/// TriMesh::adjacency. Thread: any; nonblocking.
SurfacePoint walk(const TriMesh& mesh, std::int32_t from, const Vec3& g) noexcept;
inline constexpr int kMaxSteps = 256;

/// Normal of the surface at the point: of its triangle, the mean of both on an edge, weighted by angle around a vertex.
/// Its sign says on which side a point lies whose nearest point this is [Baerentzen2005]. Not a unit vector.
Vec3 outwardAt(const TriMesh& mesh, const SurfacePoint& point) noexcept;

}  // namespace presa::fca
