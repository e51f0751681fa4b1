#pragma once
#include <vector>

#include "framework/geometry/surface_tree.h"

namespace presa {

/// Signed distance from a closed mesh, which must outlive it: negative inside. The sign is that of the angle-weighted
/// pseudonormal of the nearest face, edge or corner [Baerentzen2005], which is right wherever the mesh is closed and
/// consistently oriented. Thread: before a run; operator() is const and may run on several threads.
class MeshDistance {
 public:
  /// `mesh` has adjacency (buildAdjacency) and at least one triangle.
  explicit MeshDistance(const TriMesh& mesh);
  /// At p [m]. `bound`: an upper bound of the distance that the caller knows, for speed [m].
  double operator()(const Vec3& p, double bound = 1e150) const;

 private:
  const TriMesh& mesh_;
  SurfaceTree tree_;
  std::vector<Vec3> face_normal_, vertex_normal_;
};

}  // namespace presa
