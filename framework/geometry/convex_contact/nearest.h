#pragma once
#include <utility>

#include "framework/geometry/closest_point.h"
#include "framework/geometry/convex_contact/hull.h"

/// Nearest points of points, segments and polyhedra.
namespace presa {

/// Of the segments a0 a1 and b0 b1: the point of each. Thread: any; nonblocking.
std::pair<Vec3, Vec3> nearestOf(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1);
/// Of a polyhedron and the point or segment of `core`, without radii. False when they meet.
/// Thread: any; nonblocking.
bool nearestOutside(const Hull& hull, const Hull& core, Vec3& on_hull, Vec3& on_core);

}  // namespace presa
