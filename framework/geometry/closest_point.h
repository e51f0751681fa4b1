#pragma once
#include "framework/math/spatial.h"

namespace presa {

/// Point of segment (a, b) nearest to p. Exact up to rounding; a == b is a point. Any unit, any scale.
Vec3 closestOnSegment(const Vec3& p, const Vec3& a, const Vec3& b);

/// Point of triangle (a, b, c) nearest to p. The result is a convex combination of the corners even when the triangle is
/// a sliver or has no area, so its distance is never too small. No tolerance, hence any unit and any scale.
/// Thread: any; no allocation. Source: [Ericson2004 5.1] by regions, with the minimum over all features for slivers.
Vec3 closestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace presa
