#pragma once
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa {

/// Hierarchy of axis-aligned boxes over the triangles of a mesh, which must outlive it: nearest distance and rays in
/// logarithmic time. Thread: before a run.
class SurfaceTree {
 public:
  explicit SurfaceTree(const TriMesh& mesh);  ///< of a mesh with at least one triangle

  /// Squared distance of p from the mesh [m^2], or `bound` when it is larger.
  double squaredDistance(const Vec3& p, double bound) const {
    std::size_t ignored = 0;
    return search(0, p, bound, ignored);
  }
  /// The triangle nearest to p. `bound`: an upper bound of the squared distance that the caller knows, for speed [m^2];
  /// one that is too small costs a second search.
  std::size_t nearest(const Vec3& p, double bound = 1e300) const {
    std::size_t triangle = kNone;
    search(0, p, bound, triangle);
    if (triangle == kNone) search(0, p, 1e300, triangle);
    return triangle;
  }
  /// Distance along `direction` (unit) at which a ray from p first meets the mesh [m]; `bound` when it is larger.
  double firstHit(const Vec3& p, const Vec3& direction, double bound) const;
  /// Whether p is inside of a closed mesh: most of three rays cross it an odd number of times.
  bool isInside(const Vec3& p) const;

 private:
  static constexpr std::size_t kLeaf = 4, kNone = static_cast<std::size_t>(-1);
  struct Node {
    AxisBox box;
    std::size_t begin = 0, end = 0, right = 0;  // right 0: a leaf
  };
  struct Ray {
    Vec3 p, direction, inverse;
    double end;  // what lies beyond is not looked at
    bool ends_at_hit;
    std::size_t crossings = 0;
  };

  const Vec3& corner(std::size_t triangle, std::size_t i) const {
    return mesh_.vertices[static_cast<std::size_t>(mesh_.triangles[triangle][i])];
  }
  std::size_t build(std::size_t begin, std::size_t end);
  double search(std::size_t index, const Vec3& p, double best, std::size_t& triangle) const;
  void follow(std::size_t index, Ray& ray) const;

  const TriMesh& mesh_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace presa
