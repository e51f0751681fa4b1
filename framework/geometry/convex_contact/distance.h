#pragma once
#include <cstdint>
#include <vector>

#include "framework/geometry/convex_contact/hull.h"

namespace presa {

/// The farthest points of a hull in any direction. Large polyhedra are searched along their edges, from a vertex that is
/// likely near. Thread: any; nonblocking except for construction.
class SupportOf {
 public:
  explicit SupportOf(Hull hull);  ///< keeps the hull, without points that are in none of its faces

  /// A farthest point, without the radius, in the direction `d` (any length, not zero), both in the hull's own frame.
  /// `near`: index of a vertex from which the search begins; it becomes that of the point found. A cylinder is round.
  Vec3 operator()(const Vec3& d, std::int32_t& near) const noexcept;
  const Hull& hull() const noexcept { return hull_; }  ///< in its own frame

 private:
  Hull hull_;
  std::vector<std::int32_t> first_, neighbours_;  // by vertex; empty: all vertices are looked at
};

/// A hull in a frame that two hulls have in common.
struct PlacedSupport {
  const SupportOf& support;  ///< of the hull
  Mat3 R;                    ///< from the hull's frame into the common one
  Vec3 p;                    ///< origin of the hull's frame in the common one [m]
};

/// How far apart two convex solids are, in their common frame.
struct ConvexDistance {
  /// Result of distance().
  enum class Kind : std::uint8_t {
    kNearest,  ///< all members are set
    kBeyond,   ///< farther apart than was asked for: `gap` is a lower bound, that of a plane and its farthest points
    kOverlap,  ///< the solids overlap without their radii: nothing is set
  };
  Kind kind = Kind::kOverlap;    ///< which members are set
  Vec3 nhat_AB = Vec3::UnitZ();  ///< unit, from A into B, along the shortest way
  double gap = 0;                ///< distance of the surfaces; negative: they overlap by their radii alone [m]
  Vec3 on_a = Vec3::Zero(),      ///< nearest point of A's surface [m]
      on_b = Vec3::Zero();       ///< the same of B
};

/// What distance() remembers of a pair, so that the next search is short.
struct DistanceMemory {
  Vec3 nhat_AB = Vec3::Zero();  ///< of the last search; zero: none
  std::int32_t a = 0,           ///< nearest vertex of A
      b = 0;                    ///< the same of B
};

/// A plane between two convex solids along a given direction.
struct SupportingPlane {
  Vec3 nhat_AB = Vec3::UnitZ();  ///< unit, from A into B
  double gap = 0;                ///< all of B lies at least this far beyond all of A; negative: they overlap [m]
  Vec3 on_a = Vec3::Zero(),      ///< point of A's surface farthest along it [m]
      on_b = Vec3::Zero();       ///< point of B's surface farthest against it [m]
};
/// The plane along the unit vector `nhat_AB`. Thread: any; nonblocking.
SupportingPlane planeAlong(const PlacedSupport& A, const PlacedSupport& B, const Vec3& nhat_AB,
                           DistanceMemory& memory) noexcept;
/// The plane of that face of A or B along which they overlap least; along the line between their origins if neither has
/// faces. Thread: any; nonblocking.
SupportingPlane planeOfFaces(const PlacedSupport& A, const PlacedSupport& B, DistanceMemory& memory) noexcept;

/// Distance of two convex solids [Gilbert1988; van den Bergen 1999], exact for polyhedra up to rounding; up to 1e-8 of
/// the distance where a cylinder is involved. A search that shows that the gap exceeds `beyond` [m] stops there. Thread:
/// any; nonblocking.
ConvexDistance distance(const PlacedSupport& A, const PlacedSupport& B, double beyond, DistanceMemory& memory) noexcept;

}  // namespace presa
