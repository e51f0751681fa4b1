#pragma once
#include <algorithm>

#include "framework/core/math/spatial.h"

namespace presa {

/// Point of segment (a, b) nearest to p. Exact up to rounding; a == b is a point. Any unit, any scale.
Vec3 closestOnSegment(const Vec3& p, const Vec3& a, const Vec3& b);

/// A triangle with the products that a closest-point query needs, computed once for many queries of the same triangle.
struct PreparedTriangle {
  /// Below this sine of the angle at a corner, rounding may put a point into the wrong region.
  static constexpr double kSliverSine = 1e-4;

  PreparedTriangle() = default;  ///< the point 0, a sliver
  /// Corners in any unit; either orientation.
  PreparedTriangle(const Vec3& corner_a, const Vec3& corner_b, const Vec3& corner_c)
      : a(corner_a),
        b(corner_b),
        c(corner_c),
        ab(corner_b - corner_a),
        ac(corner_c - corner_a),
        ab_ab(ab.squaredNorm()),
        ac_ac(ac.squaredNorm()),
        ab_ac(ab.dot(ac)) {
    // (twice the area)^2 against the two longest edges: small for needles and for flat triangles alike
    const double area = ab_ab * ac_ac - ab_ac * ab_ac;
    const double longest = std::max({ab_ab, ac_ac, (c - b).squaredNorm()});
    sliver = !(area > kSliverSine * kSliverSine * longest * longest);
  }
  Vec3 a = Vec3::Zero(),   ///< corner
      b = Vec3::Zero(),    ///< corner
      c = Vec3::Zero();    ///< corner
  Vec3 ab = Vec3::Zero(),  ///< b - a
      ac = Vec3::Zero();   ///< c - a
  double ab_ab = 0,        ///< ab . ab
      ac_ac = 0,           ///< ac . ac
      ab_ac = 0;           ///< ab . ac
  bool sliver = true;      ///< use closestOnSliver(): the region test is not reliable for this triangle
};

namespace detail {
/// Minimum over the three edges and the face: correct for every shape, and slower than the region test.
Vec3 closestOnSliver(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);
}  // namespace detail

/// Point of the triangle nearest to p. The result is always a convex combination of the corners, also for slivers and
/// triangles without area, so the distance is never underestimated. No absolute tolerance: any unit and any scale.
/// Thread: any; no allocation. Source: region test of [Ericson2004 5.1]; for slivers the minimum over all features.
inline Vec3 closestOnTriangle(const Vec3& p, const PreparedTriangle& t) {
  if (t.sliver) return detail::closestOnSliver(p, t.a, t.b, t.c);
  // corner, edge or inside: the region in which p lies
  const Vec3 ap = p - t.a;
  const double d1 = t.ab.dot(ap), d2 = t.ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return t.a;
  const double d3 = d1 - t.ab_ab, d4 = d2 - t.ab_ac;
  if (d3 >= 0 && d4 <= d3) return t.b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return t.a + t.ab * (d1 / (d1 - d3));
  const double d5 = d1 - t.ab_ac, d6 = d2 - t.ac_ac;
  if (d6 >= 0 && d5 <= d6) return t.c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return t.a + t.ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return t.b + (t.c - t.b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double sum = va + vb + vc;
  return t.a + t.ab * (vb / sum) + t.ac * (vc / sum);
}

/// As above for a single query of triangle (a, b, c).
inline Vec3 closestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  return closestOnTriangle(p, PreparedTriangle(a, b, c));
}

}  // namespace presa
