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

/// How exactly a distance is to be known [m].
struct DistanceWanted {
  double tolerance = 0;  ///< difference of the two bounds
  double floor = 0;  ///< what is below it may have this as its upper bound: surfaces that coincide take long otherwise
  double give_up =
      std::numeric_limits<double>::infinity();  ///< a larger one ends the search: the upper bound is infinite
};

/// One-sided Hausdorff distance: the max, over all points of `from`, of the distance to `to`. Both bounds are proven.
/// Triangles of `from` are halved until their bound is below what was found: the distance from one triangle of `to` is
/// a convex function, largest at a corner, and no distance grows faster than the way along `from`. Thread: any, not the
/// haptic group.
SurfaceDistance surfaceDistance(const TriMesh& from, const TriMesh& to, const DistanceWanted& wanted,
                                const GoOn& go_on = {});

/// The same for any distance from a set, of which only the second property is used.
SurfaceDistance largestDistance(const TriMesh& from, const std::function<double(const Vec3&)>& distance,
                                double tolerance, const GoOn& go_on = {});

}  // namespace presa
