#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa::bench {

/// A plain bounding box tree over the triangles of one mesh, for comparison: the cost of finding the surface without
/// knowledge from the previous tick and without other work. Boxes are in single precision, rounded outwards, those of
/// two children in one cache line. Leaves hold up to four triangles, their bounding spheres in one cache line and their
/// corners contiguous in the order of the tree. Triangles must not be slivers. Frame: mesh coordinates. Thread: any.
class PlainTree {
 public:
  explicit PlainTree(const TriMesh& mesh);

  struct Found {
    Vec3 nearest = Vec3::Zero();       ///< point of the mesh closest to the query
    double distance = 0;               ///< distance to it [m]
    std::vector<std::int32_t> within;  ///< triangles not farther than `radius`
  };
  /// Searches from the root down, the nearer child first. `found` keeps its memory.
  void query(const Vec3& p, double radius, Found& found) const;

  /// Centre of a ball of this radius that moves from `start` along `direction` into the mesh and just touches it.
  Vec3 rest(const Vec3& start, const Vec3& direction, double radius) const;

 private:
  static constexpr int kLeaf = 4;
  using Four = float __attribute__((vector_size(16)));
  /// Child >= 0: index of an inner node; otherwise ~child is a leaf.
  struct alignas(64) Node {
    Four low_xy, high_xy;  ///< x, x, y, y of the two children
    Four z;                ///< low, low, high, high
    std::array<std::int32_t, 2> child;
  };
  struct Corners {
    Vec3 a, b, c;
    std::int32_t id = -1;
  };
  /// Bounding spheres of up to four triangles; unused ones have radius -infinity.
  struct alignas(64) Spheres {
    float x[kLeaf] = {}, y[kLeaf] = {}, z[kLeaf] = {}, radius[kLeaf];
  };
  std::int32_t build(std::vector<std::int32_t>& order, std::size_t begin, std::size_t end, const TriMesh& mesh,
                     const std::vector<Vec3>& middles);
  std::int32_t addLeaf(const std::vector<std::int32_t>& order, std::size_t begin, std::size_t end, const TriMesh& mesh);
  void bound(Node& node, std::size_t side, std::vector<std::int32_t>& order, std::size_t begin, std::size_t end,
             const TriMesh& mesh) const;

  std::vector<Node> nodes_;
  std::vector<Spheres> spheres_;    ///< per leaf
  std::vector<Corners> triangles_;  ///< kLeaf per leaf
};

}  // namespace presa::bench
