#pragma once
#include <array>
#include <utility>

#include "framework/geometry/convex_contact/hull.h"

/// Cylinders as convex polyhedra that never show their corners: for every contact a prism is turned about the axis until
/// one of its corners, which lie on the cylinder, points at the other body. A wheel rolls on its true radius and a coin
/// wobbles on its true rim. Where the curved side touches, the axis with the radius stands for the cylinder instead.
namespace presa {

/// Corners of each end of the prism: as many as a manifold has points, so that an end lies on all of them.
constexpr int kCorners = 8;
/// Along z, centred; `length` between the flat ends [m].
Hull cylinderHull(double radius, double length);

/// The memory of one cylinder's contact with one other body.
struct CylinderTurn {
  double angle = 0;  ///< of the prism's first corner about the axis [rad]
};

/// The stand-ins of one cylinder, in W. Keeps its memory from call to call.
class CylinderStandIn {
 public:
  /// Sphere or segment deep inside the cylinder at X_WC, from which the way to the other body is measured.
  const Hull& core(const Hull& cylinder, const Pose& X_WC);
  /// What collides with a body in the unit direction `towards_W` from the core.
  const Hull& facing(const Hull& cylinder, const Pose& X_WC, const Vec3& towards_W, CylinderTurn& turn);

 private:
  Hull core_, side_, prism_;
};

/// Two hulls in W as they face each other, with stand-ins for cylinders. Keeps its memory from call to call.
class FacingHulls {
 public:
  /// One of the two.
  struct Side {
    const Hull& hull;    ///< in its own frame
    Pose X_WH;           ///< of that frame
    const Hull* placed;  ///< the hull in W; not read of a cylinder
    CylinderTurn* turn;  ///< read and written for a cylinder
  };
  /// In W; valid until the next call.
  std::pair<const Hull*, const Hull*> of(const Side& A, const Side& B);

 private:
  std::array<CylinderStandIn, 2> stand_ins_;
};

/// Unit vector along the shortest way from A to B, of which at most one has faces; from centre to centre where they meet.
Vec3 shortestWay(const Hull& A, const Hull& B);

}  // namespace presa
