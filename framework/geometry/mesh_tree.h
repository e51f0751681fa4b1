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

/// A linear lower bound of a distance: for every point p, the distance of p from the bounded set is at least
/// nhat . p + offset. The distance from a convex set is a convex function of p, so it lies above its tangent planes.
struct TangentBound {
  Vec3 nhat = Vec3::Zero();  ///< unit; zero: `offset` alone, a bound of any point
  double offset = 0;         ///< [m]
  double at(const Vec3& p) const noexcept { return nhat.dot(p) + offset; }  ///< lower bound of the distance of p [m]
};

/// Immutable bounding-volume hierarchy over the triangles of one mesh. The bounding volume of a node is an oriented box
/// whose thin side is the mean normal of its triangles. A patch of size s on a smooth surface with radius of curvature
/// R is s^2 / 8R thick, so such a box fits more tightly than an axis-aligned one and few nodes come near a touching
/// fingertip.
/// Frame: mesh coordinates [m]. Thread: any; queries are const, allocate nothing and take no lock.
/// Throws std::invalid_argument when the mesh is empty or has a vertex that is not finite.
class MeshTree {
 public:
  static constexpr int kLeafTriangles = 6;  ///< facets of a leaf at the most

  /// Single precision halves the memory. `half` is rounded up so that the box with rounded centre and axes encloses the
  /// node.
  struct Node {
    std::array<float, 3> center{},  ///< of the box [m]
        normal{0, 0, 1},            ///< thin side of the box, unit
        along{1, 0, 0};             ///< square to `normal`, unit
    std::array<float, 3> half{};    ///< half extents along normal, along, and normal x along [m]
    std::int32_t first = 0;         ///< inner node: left child, the right child follows it; leaf: first facet
    std::int32_t count = 0;         ///< number of facets of a leaf; 0: inner node
    bool isLeaf() const noexcept { return count > 0; }  ///< its facets are `first` to first + count - 1
    float size() const noexcept { return std::max({half[0], half[1], half[2]}); }  ///< half of the longest edge [m]
  };
  /// A triangle, stored in the order of the leaves.
  struct Facet {
    TriMesh::Triangle corners{};  ///< indices into this tree's own copy of the vertices: read with corner()
    std::int32_t id = -1;         ///< index of the triangle in mesh()
  };

  explicit MeshTree(std::shared_ptr<const TriMesh> mesh);  ///< keeps `mesh`; throws as above

  const TriMesh& mesh() const noexcept { return *mesh_; }  ///< the mesh that it was made of
  static constexpr std::int32_t kRoot = 0;                 ///< node of the whole mesh
  /// Node i < nodeCount(), unchecked.
  const Node& node(std::int32_t i) const noexcept { return nodes_[static_cast<std::size_t>(i)]; }
  std::size_t nodeCount() const noexcept { return nodes_.size(); }  ///< inner nodes and leaves
  const Facet& facet(std::int32_t i) const noexcept { return facets_[static_cast<std::size_t>(i)]; }  ///< unchecked
  /// Corner i (0 to 2) of a facet [m].
  const Vec3& corner(const Facet& facet, std::size_t i) const noexcept {
    return vertices_[static_cast<std::size_t>(facet.corners[i])];
  }

  /// The axes of a node's box as columns: normal, along, normal x along. Orthonormal to single precision only; the box
  /// is defined by exactly these axes.
  static Mat3 axesOf(const Node& node) noexcept {
    Mat3 axes;
    axes.col(0) << node.normal[0], node.normal[1], node.normal[2];
    axes.col(1) << node.along[0], node.along[1], node.along[2];
    axes.col(2) = axes.col(0).cross(axes.col(1));
    return axes;
  }
  /// In mesh coordinates [m].
  static Vec3 centerOf(const Node& node) noexcept { return {node.center[0], node.center[1], node.center[2]}; }

  /// Tangent bound of a node's triangles at p; `distance` is its value there [m], 0 when p is inside the box.
  TangentBound bound(std::int32_t node, const Vec3& p, double& distance) const noexcept;

  /// A cut through the tree that holds every triangle within `radius` of `center`: at most out.size() nodes, refined by
  /// splitting the largest node first. Returns their number. Room for one node gives the root.
  std::size_t cut(const Vec3& center, double radius, std::span<std::int32_t> out) const noexcept;
  /// The same for any set of triangles: keep(node) says whether a child may hold one of them. The root is kept unasked.
  template <class Keep>
  std::size_t cutWhere(const Keep& keep, std::span<std::int32_t> out) const;

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

  /// Bounding sphere of all vertices [m].
  const Vec3& sphereCenter() const noexcept { return sphere_center_; }
  double sphereRadius() const noexcept { return sphere_radius_; }  ///< about sphereCenter() [m]

 private:
  std::shared_ptr<const TriMesh> mesh_;
  std::vector<Node> nodes_;
  std::vector<Facet> facets_;
  std::vector<Vec3> vertices_;  // copy in the order of the leaves: neighbours share a cache line
  Vec3 sphere_center_ = Vec3::Zero();
  double sphere_radius_ = 0;
};

template <class Keep>
std::size_t MeshTree::cutWhere(const Keep& keep, std::span<std::int32_t> out) const {
  if (out.empty()) return 0;
  std::size_t count = 1;
  out[0] = kRoot;
  while (true) {
    std::size_t largest = count;
    for (std::size_t i = 0; i < count; ++i) {
      const Node& n = node(out[i]);
      if (n.isLeaf()) continue;
      if (largest == count || n.size() > node(out[largest]).size()) largest = i;
    }
    if (largest == count) return count;
    const std::int32_t left = node(out[largest]).first;
    const bool keep_left = keep(left), keep_right = keep(left + 1);
    if (keep_left && keep_right && count == out.size()) return count;
    if (keep_left && keep_right) {
      out[largest] = left;
      out[count++] = left + 1;
    } else if (keep_left || keep_right) {
      out[largest] = keep_left ? left : left + 1;
    } else {
      out[largest] = out[--count];
      if (count == 0) return 0;
    }
  }
}

inline TangentBound MeshTree::bound(std::int32_t index, const Vec3& p, double& distance) const noexcept {
  // The axes are unit vectors only to single precision; this factor [-] keeps the bound below the true distance.
  constexpr double kShorter = 1 - 5e-7;
  const Node& n = node(index);
  const Mat3 axes = axesOf(n);
  const Vec3 center = centerOf(n), at = axes.transpose() * (p - center), half(n.half[0], n.half[1], n.half[2]);
  const Vec3 beyond = (at - half).cwiseMax(0.0) + (at + half).cwiseMin(0.0);
  const double squared = beyond.squaredNorm();
  TangentBound result;
  distance = 0;
  if (!(squared > 0)) return result;
  // for every q of the box: beyond . axes^T (q - center) <= |beyond| . half, even if the axes are not quite orthonormal
  const double inverse = kShorter / std::sqrt(squared);
  result.nhat = axes * (inverse * beyond);
  result.offset = -result.nhat.dot(center) - inverse * beyond.cwiseAbs().dot(half);
  distance = std::max(0.0, result.at(p));
  return result;
}

}  // namespace presa
