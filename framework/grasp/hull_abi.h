#pragma once
#include <cstdint>

/// Interface between the framework and the plug-in presa_hull.
namespace presa {

/// Called for each facet of a hull: the points x inside of it have normal . x <= offset. `normal` has unit length and
/// `dimension` elements, valid during the call.
using HullFacetFunction = void (*)(void* user, const double* normal, double offset);

/// Symbol kHullSymbol: convex hull of `count` points, one after the other in `points`, in 2 to 8 dimensions. Returns 0,
/// or the error code of the library when the points are too flat for a hull; then no facet was told.
using HullFunction = std::int32_t (*)(const double* points, std::int32_t count, std::int32_t dimension,
                                      HullFacetFunction facet, void* user);

inline constexpr const char* kHullSymbol = "presaConvexHull";

}  // namespace presa
