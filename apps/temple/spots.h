#pragma once
#include <vector>

#include "apps/temple/building/block.h"
#include "framework/core/math/random.h"

namespace presa::temple {

/// Ground within reach of the fingers: a rectangle [m] around the building's site, which must stay free.
struct Field {
  double left = 0, right = 0, front = 0, back = 0;
  struct Site {
    double left = 0, right = 0, front = 0, back = 0;
  } site;
  bool holds(const Vec3& p_W) const { return p_W.x() > left && p_W.x() < right && p_W.y() > front && p_W.y() < back; }
};

/// A field as large as the blocks need, at most the reach of two PERCRO arms: 600 mm wide and 300 mm deep
/// [Bergamasco2006 2.1.1].
Field fieldFor(const Building& building);

/// Corners of a block's physics shape (cylinder: of a prism around it), in W [m].
std::vector<Vec3> cornersOf(const Block& block, const Pose& X_WB);

/// Occupied areas of the field; finds a spot for the next block.
class Spots {
 public:
  explicit Spots(const Field& field) : field_(field) {}
  /// Adds a block at rest, or one about to be dropped.
  void take(const std::vector<Vec3>& corners);
  /// Removes the blocks added last until `count` are left.
  void keep(std::size_t count) { taken_.resize(count); }
  std::size_t count() const { return taken_.size(); }
  /// Finds a random pose a few millimetres above the ground or the blocks below, the lowest of several draws, that
  /// overlaps none of the blocks with index `from` or later when seen from above. False when there is none.
  bool find(const Block& block, std::size_t from, RandomStream& random, Pose& X_WB) const;

 private:
  struct Shadow {                   ///< projection onto the ground
    std::vector<double> low, high;  ///< bounds along each of several directions [m]
    double top = 0;
  };
  static Shadow shadowOf(const std::vector<Vec3>& corners);
  static bool apart(const Shadow& a, const Shadow& b);
  bool onSite(const std::vector<Vec3>& corners) const;
  Field field_;
  std::vector<Shadow> taken_;
};

}  // namespace presa::temple
