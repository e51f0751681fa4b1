#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa::fca {

/// A mesh with all that the walk needs of a triangle in one place: on a fine mesh every crossed edge leads to memory
/// that no tick has met yet. 88 bytes a triangle. Thread: any.
class WalkMesh {
 public:
  /// A triangle and its neighbours.
  struct Face {
    std::array<Vec3, 3> corners;  ///< counter-clockwise seen from outside
    TriMesh::Triangle across;     ///< as TriMesh::adjacency
  };
  explicit WalkMesh(const TriMesh& mesh);  ///< has an adjacency; must outlive this

  const Face& face(std::int32_t t) const noexcept { return faces_[static_cast<std::size_t>(t)]; }  ///< of triangle t
  /// Index of a vertex of the mesh in triangle t, which must have it.
  std::size_t indexIn(std::int32_t t, std::int32_t vertex) const noexcept;
  /// Vertex of the mesh at a corner.
  std::int32_t vertex(std::int32_t t, std::size_t corner) const noexcept {
    return mesh_.triangles[static_cast<std::size_t>(t)][corner];
  }
  /// Begins to load the neighbours of triangle t: the next tick crosses into one of them.
  void fetchAround(std::int32_t t) const noexcept {
    for (const std::int32_t neighbour : face(t).across) {
      if (neighbour < 0) continue;
      __builtin_prefetch(&face(neighbour));
      __builtin_prefetch(&face(neighbour).across);
    }
  }

 private:
  const TriMesh& mesh_;
  std::vector<Face> faces_;
};

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
/// neighbour is nearer, until none is. The way never leaves the surface. A crossed edge leads to a half-plane nearer to
/// g, each later step to a nearer point; the end is a local minimum. At most kMaxSteps triangles each. Thread: any;
/// nonblocking.
SurfacePoint walk(const WalkMesh& mesh, std::int32_t from, const Vec3& g) noexcept;
inline constexpr int kMaxSteps = 256;

/// Normal of the surface at the point: of its triangle, the mean of both on an edge, weighted by angle around a vertex.
/// Its sign says on which side a point lies whose nearest point this is [Baerentzen2005]. Not a unit vector.
Vec3 outwardAt(const WalkMesh& mesh, const SurfacePoint& point) noexcept;

}  // namespace presa::fca
