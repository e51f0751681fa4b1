#pragma once
#include <functional>
#include <limits>

#include "framework/geometry/tri_mesh.h"

namespace presa {

/// The largest distance of a point of one surface from another, between two bounds [m].
struct SurfaceDistance {
  double low = 0;   ///< at a point that was looked at
  double high = 0;  ///< no point is farther; infinity: told to stop
};

/// Called now and then with the share that is done, 0 to 1; false stops.
using GoOn = std::function<bool(double)>;

/// One-sided Hausdorff distance: the max, over all points of `from`, of the distance to `to`. Both bounds are proven; they
/// differ by at most `tolerance` [m]. Triangles of `from` are halved until their bound is below what was found: the
/// distance from one triangle of `to` is a convex function, largest at a corner, and no distance grows faster than the way
/// along `from`. Ends with the upper bound infinity where `low` exceeds `give_up` [m]. Thread: any, not the haptic group.
SurfaceDistance surfaceDistance(const TriMesh& from, const TriMesh& to, double tolerance, const GoOn& go_on = {},
                                double give_up = std::numeric_limits<double>::infinity());

/// The same for any distance from a set, of which only the second property is used.
SurfaceDistance largestDistance(const TriMesh& from, const std::function<double(const Vec3&)>& distance,
                                double tolerance);

}  // namespace presa
