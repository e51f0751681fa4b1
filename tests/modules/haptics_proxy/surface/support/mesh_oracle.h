#pragma once
#include <cstdint>
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa::test {

/// Distances, crossings and winding numbers of a mesh, computed independently of Presa's geometry with its own tree of
/// boxes and its own formulas. Mesh coordinates [m].
class MeshOracle {
 public:
  explicit MeshOracle(const TriMesh& mesh);

  struct Nearest {
    double distance = 1e300;
    Vec3 point = Vec3::Zero();
    std::int32_t triangle = -1;
  };
  /// The nearest point of the surface within `within`; else triangle -1.
  Nearest nearest(const Vec3& p, double within = 1e300) const;
  /// Whether the segment crosses the surface.
  bool crosses(const Vec3& a, const Vec3& b) const;
  /// Triangles whose boxes come within `radius` of p.
  void near(const Vec3& p, double radius, std::vector<std::int32_t>& found) const;
  /// Winding number of the surface around p: 0 outside a closed mesh. Signed crossings of three rays; if these disagree
  /// (an edge was hit, or the mesh is open) the rounded sum of the solid angles of all triangles [Jacobson2013].
  int winding(const Vec3& p) const;
  /// Sum of the signed solid angles of all triangles over 4 pi.
  double solidAngles(const Vec3& p) const;

  std::array<Vec3, 3> corners(std::int32_t triangle) const;
  /// Unit normal by the order of the vertices.
  Vec3 normal(std::int32_t triangle) const;
  std::size_t size() const { return triangles_.size(); }

 private:
  struct Node {
    Vec3 low, high;
    std::int32_t first = 0, count = 0;  ///< count 0: children at first and first + 1
  };
  struct Corners {
    Vec3 a, b, c;
  };
  void split(std::size_t node, std::int32_t first, std::int32_t count, std::vector<Vec3>& middles);
  int crossings(const Vec3& p, const Vec3& direction) const;

  std::vector<Corners> triangles_;      ///< in the order of the tree
  std::vector<std::int32_t> ids_;       ///< index in the mesh, for each of these
  std::vector<std::int32_t> place_of_;  ///< inverse of ids_
  std::vector<Node> nodes_;
};

/// The point of triangle abc nearest to p: projection to plane, edges and corners.
Vec3 nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Detects when a moving point has got inside a mesh. It cannot get in without its path crossing the surface, so
/// winding numbers are computed only after a crossing (a chord that cuts a corner crosses, too, and is no fault).
class InsideWatch {
 public:
  explicit InsideWatch(const MeshOracle& mesh) : mesh_(mesh) {}
  /// Whether the point is inside after moving to p.
  bool update(const Vec3& p);

 private:
  const MeshOracle& mesh_;
  Vec3 last_ = Vec3::Zero();
  bool known_ = false, inside_ = false;
};

}  // namespace presa::test
