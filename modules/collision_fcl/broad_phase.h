#pragma once
#include <memory>
#include <vector>

#include "framework/core/math/spatial.h"

namespace presa {

/// Bounding spheres of bodies in FCL's dynamic AABB tree. Finds the spheres near a point in logarithmic time. Frame: W.
/// Thread: one; allocates at construction only.
class BroadPhase {
 public:
  /// Reserves memory for `count` spheres.
  explicit BroadPhase(std::size_t count);
  ~BroadPhase();
  BroadPhase(const BroadPhase&) = delete;
  BroadPhase& operator=(const BroadPhase&) = delete;

  /// Places sphere `i` [m]; takes effect at the next refresh().
  void place(std::size_t i, const Vec3& center, double radius);
  /// Updates the tree after a round of place().
  void refresh();
  /// Fills `out` with the indices of the spheres within `radius` of `center`, in increasing order. `out` must have the
  /// capacity.
  void near(const Vec3& center, double radius, std::vector<std::int32_t>& out) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace presa
