#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa {

/// A triangle in reach of a query point.
struct NearTriangle {
  double distance = 0;   ///< from the query centre to the nearest point of the triangle [m]
  std::int32_t id = -1;  ///< index in the mesh
};

/// What one gather found.
struct Gathered {
  double radius =
      0;  ///< every triangle not farther than this is in the list [m]; below the radius asked for when capped
  bool capped = false;
};

/// Spatial index over the triangles of one mesh: an FCL hierarchy of axis-aligned boxes, used as an index only. The
/// traversal and the point-triangle distances are our own, because FCL's normals and depths are wrong in places.
/// Frame: mesh coordinates. Thread: gather is const and only reads; any number of threads.
/// Throws std::invalid_argument when the mesh is empty or has a vertex that is not finite (one such vertex would
/// silence every query).
class TriangleIndex {
 public:
  explicit TriangleIndex(std::shared_ptr<const TriMesh> mesh);
  ~TriangleIndex();
  TriangleIndex(TriangleIndex&&) noexcept;
  TriangleIndex& operator=(TriangleIndex&&) noexcept;

  /// Fills `out` with the triangles within `radius` [m] of `center`, at most the `capacity` nearest, as a max-heap by
  /// (distance, id). Cost grows with the triangles found, not with the mesh; once `capacity` are found the search
  /// radius shrinks to the farthest of them. Allocates only while `out` has less capacity than needed.
  Gathered gather(const Vec3& center, double radius, std::size_t capacity, std::vector<NearTriangle>& out) const;

  const TriMesh& mesh() const noexcept { return *mesh_; }
  /// Sphere around all vertices, mesh coordinates [m].
  const Vec3& sphereCenter() const noexcept { return sphere_center_; }
  double sphereRadius() const noexcept { return sphere_radius_; }

 private:
  struct Tree;
  std::shared_ptr<const TriMesh> mesh_;
  std::unique_ptr<Tree> tree_;
  Vec3 sphere_center_ = Vec3::Zero();
  double sphere_radius_ = 0;
};

/// Order of nearness; ids decide between triangles that share their nearest corner or edge, so that what a full list
/// keeps does not depend on the order of the traversal.
inline bool nearer(const NearTriangle& a, const NearTriangle& b) noexcept {
  return a.distance != b.distance ? a.distance < b.distance : a.id < b.id;
}

}  // namespace presa
