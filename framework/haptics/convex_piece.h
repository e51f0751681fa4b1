#pragma once
#include <algorithm>
#include <cstdint>
#include <variant>

#include "framework/core/math/spatial.h"
#include "framework/geometry/closest_point.h"

namespace presa {

/// A primitive placed in the working frame.
struct Primitive {
  /// Shape; its centre is the origin of G, its axis the z axis.
  enum class Kind : std::uint8_t { kBox, kSphere, kCylinder, kCapsule };
  Kind kind = Kind::kBox;    ///< selects which of the sizes below count
  Pose X_AG;                 ///< geometry frame in the working frame
  Vec3 half = Vec3::Zero();  ///< box: half edge lengths
  double radius = 0;         ///< sphere, cylinder, capsule
  double half_length = 0;    ///< cylinder, capsule: half of the axis along z
};

/// A convex piece of a body's haptic geometry: one triangle of a mesh, or a whole primitive. The proxy uses a piece
/// only through its distance, which is a convex function of the point; therefore the sweep below is exact for every
/// kind.
struct ConvexPiece {
  std::int32_t body = -1;                           ///< index into Scene::bodies
  std::int32_t id = -1;                             ///< triangle: index in the body's mesh
  std::variant<PreparedTriangle, Primitive> shape;  ///< triangle: corners in the working frame
};

/// Direction and distance from a piece to a point.
struct Nearest {
  Vec3 nhat;        ///< unit, from the piece towards the point (outward when inside a primitive)
  double distance;  ///< >= 0 outside; negative inside a primitive
};

/// Distance of p from a triangle, two-sided. For a point on the triangle the normal is the triangle's own.
inline Nearest nearest(const PreparedTriangle& t, const Vec3& p) noexcept {
  const Vec3 away = p - closestOnTriangle(p, t);
  const double distance = away.norm();
  if (distance > 0) return {away / distance, distance};
  const Vec3 normal = t.ab.cross(t.ac);
  const double area = normal.norm();
  return {area > 0 ? Vec3(normal / area) : Vec3(Vec3::UnitZ()), 0};
}
/// Distance of p from the piece. Triangles are two-sided; for a point on a triangle the normal is
/// the triangle's own. Thread: any; nonblocking.
Nearest nearest(const ConvexPiece& piece, const Vec3& p) noexcept;

inline constexpr double kNoTouch = 2.0;  ///< larger than any path parameter in [0, 1]

/// First s in [0, limit] at which a sphere of radius r, whose centre moves from x to x + s move, touches a convex set
/// with distance function `nearest_to(p)`; kNoTouch when it does not. `at` is nearest_to(x). The distance is convex
/// along the line, so Newton's method from s = 0 approaches the first root from below and never passes it: no
/// tunnelling through thin plates at any speed. `tolerance`: gap that counts as touch [m].
template <class NearestTo>
double firstTouchOf(const NearestTo& nearest_to, Nearest at, const Vec3& x, const Vec3& move, double limit, double r,
                    double tolerance) noexcept {
  constexpr int kMaxSteps = 64;  // convergence is quadratic; at a grazing touch the gap halves per step
  double s = 0;
  for (int step = 0; step < kMaxSteps; ++step) {
    const double gap = at.distance - r;
    const double slope = at.nhat.dot(move);
    if (slope >= 0) return kNoTouch;  // by convexity the distance does not decrease any more
    if (gap <= tolerance) return s;
    s += gap / -slope;
    if (s > limit) return kNoTouch;
    at = nearest_to(x + s * move);
  }
  return s;
}

/// First touch of one convex piece.
inline double firstTouch(const ConvexPiece& piece, const Nearest& at, const Vec3& x, const Vec3& move, double limit,
                         double r, double tolerance) noexcept {
  return firstTouchOf([&](const Vec3& p) { return nearest(piece, p); }, at, x, move, limit, r, tolerance);
}

}  // namespace presa
