#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa {

/// A distance bound: for every point p, the distance of p from what is bounded is at least nhat . p + offset. The distance
/// from a convex set is a convex function of the point, so it lies above each of its tangent planes.
struct TangentBound {
  Vec3 nhat = Vec3::Zero();
  double offset = 0;  ///< [m]
  double at(const Vec3& p) const noexcept { return nhat.dot(p) + offset; }
};

/// Immutable hierarchy over the triangles of one mesh, shared by every thread. Each node is bounded by a disc: a flat cylinder
/// along the mean normal of its triangles. A patch of a smooth surface of size s is s^2 / 8R thick, so a disc lies closer than
/// a box, whichever way the surface faces: few nodes come near a fingertip that touches.
/// Frame: mesh coordinates. Thread: any; queries are const, allocate nothing and take no lock.
/// Throws std::invalid_argument when the mesh is empty or has a vertex that is not finite.
class MeshTree {
 public:
  static constexpr int kLeafTriangles = 6;

  /// Single precision halves the memory; `radius` and `half` are rounded up for the axis and centre as they are rounded.
  struct Node {
    std::array<float, 3> center{}, axis{0, 0, 1};
    float radius = 0;        ///< of the disc [m]
    float half = 0;          ///< half of its thickness [m]
    std::int32_t first = 0;  ///< inner: the left child, the right one is the next; leaf: its first facet
    std::int32_t count = 0;  ///< facets of a leaf; 0: inner
    bool isLeaf() const noexcept { return count > 0; }
  };
  /// A triangle, in the order of the leaves.
  struct Facet {
    TriMesh::Triangle corners{};  ///< vertices
    std::int32_t id = -1;         ///< triangle of the mesh
  };

  explicit MeshTree(std::shared_ptr<const TriMesh> mesh);

  const TriMesh& mesh() const noexcept { return *mesh_; }
  static constexpr std::int32_t kRoot = 0;
  const Node& node(std::int32_t i) const noexcept { return nodes_[static_cast<std::size_t>(i)]; }
  std::size_t nodeCount() const noexcept { return nodes_.size(); }
  const Facet& facet(std::int32_t i) const noexcept { return facets_[static_cast<std::size_t>(i)]; }
  const Vec3& corner(const Facet& facet, std::size_t i) const noexcept {
    return mesh_->vertices[static_cast<std::size_t>(facet.corners[i])];
  }

  /// To double precision, with one step of Newton's method towards unit length.
  static Vec3 axisOf(const Node& node) noexcept {
    const Vec3 axis(node.axis[0], node.axis[1], node.axis[2]);
    return axis * (1.5 - 0.5 * axis.squaredNorm());
  }
  static Vec3 centerOf(const Node& node) noexcept { return {node.center[0], node.center[1], node.center[2]}; }

  /// Tangent bound of a node's triangles, taken at p; its value there is `distance`, 0 where p is inside the disc.
  TangentBound bound(std::int32_t node, const Vec3& p, double& distance) const noexcept;

  /// Nodes that together hold every triangle within `radius` of `center`, at most out.size() of them, largest split first.
  /// Returns how many. With room for one it is the root.
  std::size_t cut(const Vec3& center, double radius, std::span<std::int32_t> out) const noexcept;

  /// Calls visit(facet index) for every triangle of each leaf whose bound is within `radius` of `center`.
  template <class Visit>
  void forEachWithin(const Vec3& center, double radius, const Visit& visit, std::int32_t from = kRoot) const {
    double distance = 0;
    bound(from, center, distance);
    if (!(distance <= radius)) return;
    const Node& n = node(from);
    for (std::int32_t f = 0; f < n.count; ++f) visit(n.first + f);
    if (n.isLeaf()) return;
    forEachWithin(center, radius, visit, n.first);
    forEachWithin(center, radius, visit, n.first + 1);
  }

  /// Sphere around all vertices [m].
  const Vec3& sphereCenter() const noexcept { return sphere_center_; }
  double sphereRadius() const noexcept { return sphere_radius_; }

 private:
  std::shared_ptr<const TriMesh> mesh_;
  std::vector<Node> nodes_;
  std::vector<Facet> facets_;
  Vec3 sphere_center_ = Vec3::Zero();
  double sphere_radius_ = 0;
};

inline TangentBound MeshTree::bound(std::int32_t index, const Vec3& p, double& distance) const noexcept {
  constexpr double kSlack = 1e-13;  // of the lengths below: rounding
  const Node& n = node(index);
  const Vec3 axis = axisOf(n), from = p - centerOf(n);
  const double z = axis.dot(from);
  const Vec3 across = from - z * axis;
  const double rho = across.norm();
  const double over = std::abs(z) - n.half, beside = rho - n.radius;
  const double slack = kSlack * (std::abs(z) + rho + n.radius);
  TangentBound result;
  distance = 0;
  if (beside <= 0) {
    if (!(over > slack)) return result;
    result.nhat = z > 0 ? axis : Vec3(-axis);
    distance = over - slack;
  } else {
    const double up = std::max(over, 0.0), d = std::sqrt(up * up + beside * beside);
    if (!(d > slack)) return result;
    result.nhat = ((z > 0 ? up : -up) / d) * axis + (beside / (d * rho)) * across;
    distance = d - slack;
  }
  result.offset = distance - result.nhat.dot(p);
  return result;
}

}  // namespace presa
