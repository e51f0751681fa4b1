#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "framework/geometry/surface_distance.h"
#include "framework/geometry/tri_mesh.h"

/// Convex meshes, and meshes as unions of convex ones. Thread: before a run.
namespace presa {

/// Whether no vertex lies outside of the plane of any triangle by more than `tolerance` of the bounds' diagonal.
bool isConvex(const TriMesh& mesh, double tolerance = 1e-5);

/// Max number of faces, coplanar triangles counted once, of a piece of decompose().
inline constexpr std::size_t kMaxPieceFaces = 64;

/// Convex hull, closed, with at most `max_vertices` vertices: the point farthest outside is added first, so a limited
/// hull is the best inner one found that way. None for points in a plane. [Barber1996]
std::optional<TriMesh> convexHull(const std::vector<Vec3>& points, std::size_t max_vertices = 10000);

/// Convex pieces whose union is a closed mesh, but for hollows of up to `max_error` [m] that a piece may bridge, unless
/// `max_pieces` are too few. The solid is cut by planes of its own faces, so a polyhedron comes apart exactly and
/// neighbours share their cut to the bit: no cracks. Empty for a mesh that encloses no volume, and where `go_on` stopped it.
/// Deterministic.
std::vector<TriMesh> decompose(const TriMesh& mesh, std::size_t max_pieces, double max_error, const GoOn& go_on = {});

/// Hausdorff distance between the solid in a closed mesh and the union of convex pieces [m], sampled at vertices, edge
/// midpoints and triangle centres: a lower bound.
double hausdorffDistance(const TriMesh& mesh, const std::vector<TriMesh>& pieces);

}  // namespace presa
