#pragma once
#include <vector>

#include "apps/temple/building/block.h"
#include "framework/core/math/random.h"

namespace presa::temple {

/// Ground that the fingers reach: a rectangle without the building's site [m].
struct Field {
  double left = 0, right = 0, front = 0, back = 0;
  struct Site {
    double left = 0, right = 0, front = 0, back = 0;
  } site;
  bool holds(const Vec3& p_W) const { return p_W.x() > left && p_W.x() < right && p_W.y() > front && p_W.y() < back; }
};

/// As large as the blocks need, at most what two PERCRO arms reach: 600 mm wide and 300 mm deep [Bergamasco2006 2.1.1].
Field fieldFor(const Building& building);

/// Corners of a block's physics shape (of a cylinder: of a prism around it), in the world [m].
std::vector<Vec3> cornersOf(const Block& block, const Pose& X_WB);

/// What lies on the field so far, and where the next block may fall.
class Spots {
 public:
  explicit Spots(const Field& field) : field_(field) {}
  /// A block that lies, or is about to fall.
  void take(const std::vector<Vec3>& corners);
  /// Takes back what was taken last, down to `count`.
  void keep(std::size_t count) { taken_.resize(count); }
  std::size_t count() const { return taken_.size(); }
  /// A pose a few millimetres above what lies there, turned at random, with nothing of index `from` or later below or above it; the lowest
  /// of several drawn. False where none was found.
  bool find(const Block& block, std::size_t from, RandomStream& random, Pose& X_WB) const;

 private:
  struct Shadow {                   ///< from above
    std::vector<double> low, high;  ///< along each of some directions
    double top = 0;
  };
  static Shadow shadowOf(const std::vector<Vec3>& corners);
  static bool apart(const Shadow& a, const Shadow& b);
  bool onSite(const std::vector<Vec3>& corners) const;
  Field field_;
  std::vector<Shadow> taken_;
};

}  // namespace presa::temple
