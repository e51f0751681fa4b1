#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa::bench {

/// A plain tree of boxes over the triangles of one mesh, to compare with: what finding the surface costs when nothing is
/// known from the tick before and nothing else is done. Boxes in single precision, rounded outwards, the two children's
/// in one cache line; leaves of at most four triangles, the spheres around them in one cache line, their corners side
/// by side in the order of the tree. Triangles must not be slivers. Frame: mesh coordinates. Thread: any.
class PlainTree {
 public:
  explicit PlainTree(const TriMesh& mesh);

  struct Found {
    Vec3 nearest = Vec3::Zero();       ///< point of the mesh closest to the query
    double distance = 0;               ///< to it [m]
    std::vector<std::int32_t> within;  ///< triangles not farther than `radius`
  };
  /// Looks from the root down, the nearer child first. `found` keeps its memory.
  void query(const Vec3& p, double radius, Found& found) const;

  /// Where a ball of that radius lies that comes along `direction` towards the mesh's inside and just touches it.
  Vec3 rest(const Vec3& start, const Vec3& direction, double radius) const;

 private:
  static constexpr int kLeaf = 4;
  using Four = float __attribute__((vector_size(16)));
  /// Child >= 0: an inner node; else ~child is a leaf.
  struct alignas(64) Node {
    Four low_xy, high_xy;  ///< x, x, y, y of the two children
    Four z;                ///< low, low, high, high
    std::array<std::int32_t, 2> child;
  };
  struct Corners {
    Vec3 a, b, c;
    std::int32_t id = -1;
  };
  /// Four triangles, some of them none.
  struct alignas(64) Spheres {
    float x[kLeaf] = {}, y[kLeaf] = {}, z[kLeaf] = {}, radius[kLeaf];
  };
  std::int32_t build(std::vector<std::int32_t>& order, std::size_t begin, std::size_t end, const TriMesh& mesh,
                     const std::vector<Vec3>& middles);
  std::int32_t addLeaf(const std::vector<std::int32_t>& order, std::size_t begin, std::size_t end, const TriMesh& mesh);
  void bound(Node& node, std::size_t side, std::vector<std::int32_t>& order, std::size_t begin, std::size_t end,
             const TriMesh& mesh) const;

  std::vector<Node> nodes_;
  std::vector<Spheres> spheres_;    ///< of each leaf
  std::vector<Corners> triangles_;  ///< kLeaf of each leaf
};

}  // namespace presa::bench
