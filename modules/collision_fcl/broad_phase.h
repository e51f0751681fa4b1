#pragma once
#include <memory>
#include <vector>

#include "framework/core/math/spatial.h"

namespace presa {

/// Bounding spheres of bodies in FCL's dynamic tree of boxes: which of them come near a point, at a cost that grows with the
/// logarithm of their number. Frame: W. Thread: one; allocates at construction only.
class BroadPhase {
 public:
  /// Room for `count` spheres.
  explicit BroadPhase(std::size_t count);
  ~BroadPhase();
  BroadPhase(const BroadPhase&) = delete;
  BroadPhase& operator=(const BroadPhase&) = delete;

  /// Places sphere `i` [m]; seen after the next refresh().
  void place(std::size_t i, const Vec3& center, double radius);
  /// After a round of place().
  void refresh();
  /// Fills `out` with the spheres that come within `radius` of `center`, in rising order. `out` needs room for all of them.
  void near(const Vec3& center, double radius, std::vector<std::int32_t>& out) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace presa
