#pragma once
#include <functional>

#include "framework/geometry/tri_mesh.h"

namespace presa {

/// The largest distance of a point of one surface from another, between two bounds [m].
struct SurfaceDistance {
  double low = 0;   ///< at a point that was looked at
  double high = 0;  ///< no point is farther; infinity: told to stop
};

/// One-sided Hausdorff distance: the max, over all points of `from`, of the distance to `to`. Both bounds are proven; they
/// differ by at most `tolerance` [m]. Triangles of `from` are halved until their bound is below what was found: the
/// distance from one triangle of `to` is a convex function, largest at a corner, and no distance grows faster than the way
/// along `from`. `go_on` (share done, 0 to 1) is asked now and then; false stops. Thread: any, not the haptic group.
SurfaceDistance surfaceDistance(const TriMesh& from, const TriMesh& to, double tolerance,
                                const std::function<bool(double)>& go_on = {});

}  // namespace presa
