#pragma once
#include <cstdint>

#include "framework/math/spatial.h"

namespace presa {

/// A convex part of a body's haptic geometry: one triangle of a mesh, or a whole primitive. All the
/// proxy needs of it is its distance, which is a convex function of the point; that makes the sweep
/// below exact for every kind with one piece of code.
struct ConvexPiece {
  enum class Kind : std::uint8_t { kTriangle, kBox, kSphere, kCylinder, kCapsule };
  Kind kind = Kind::kTriangle;
  std::int32_t body = -1;
  Vec3 a = Vec3::Zero(), b = Vec3::Zero(), c = Vec3::Zero();  ///< triangle corners in the working frame
  Pose X_AG;                                                  ///< primitives: geometry frame in the working frame
  Vec3 half = Vec3::Zero();                                   ///< box: half edge lengths
  double radius = 0;                                          ///< sphere, cylinder, capsule
  double half_length = 0;                                     ///< cylinder, capsule: half of the axis along z
};

/// Where a piece is nearest to a point.
struct Nearest {
  Vec3 nhat = Vec3::UnitZ();  ///< unit, from the piece towards the point (outward when inside a primitive)
  double distance = 0;        ///< >= 0 outside; negative inside a primitive
};

/// Distance of p from the piece. Triangles are two-sided; for a point on a triangle the normal is
/// the triangle's own. Thread: any; nonblocking.
Nearest nearest(const ConvexPiece& piece, const Vec3& p) noexcept;

/// First s in [0, 1] at which a sphere of radius r, moving its centre from x along `move`, touches the piece;
/// 2 when it does not. The distance is convex along the line, so Newton's method from s = 0 comes up to the
/// first root from below and never passes it: thin plates hold at any speed. `tolerance`: gap taken as touch [m].
double firstTouch(const ConvexPiece& piece, const Vec3& x, const Vec3& move, double r, double tolerance) noexcept;

}  // namespace presa
