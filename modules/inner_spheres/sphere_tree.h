#pragma once
#include <cstdint>
#include <vector>

#include "framework/geometry/sphere_packing.h"

namespace presa {

/// A hierarchy of spheres around inner spheres. Immutable after construction.
class SphereTree {
 public:
  /// A sphere around others, or an inner sphere, in the coordinates of the solid.
  struct Node {
    Vec3 centre = Vec3::Zero();  ///< [m]
    double radius = 0;           ///< [m]
    std::int32_t children = -1;  ///< index of the first of two; -1: an inner sphere
  };
  /// Needs at least one sphere.
  explicit SphereTree(std::vector<InnerSphere> spheres);

  const std::vector<Node>& nodes() const noexcept { return nodes_; }  ///< the first is the root, children come in twos
  std::size_t sphereCount() const noexcept { return (nodes_.size() + 1) / 2; }  ///< inner spheres

 private:
  void build(std::vector<InnerSphere>& spheres, std::size_t begin, std::size_t end, std::size_t node);

  std::vector<Node> nodes_;
};

}  // namespace presa
