#pragma once
#include <cstddef>
#include <vector>

#include "framework/geometry/surface_distance.h"
#include "framework/geometry/tri_mesh.h"

/// What fingers and dynamics get from a mesh that is too fine for them: a photographed one. Thread: any, not the haptic
/// group.
namespace presa {

/// A coarser mesh, and how far it is from the one it was made of.
struct TouchMesh {
  TriMesh mesh;             ///< empty: told to stop
  SurfaceDistance forth;    ///< of the original from it
  SurfaceDistance back;     ///< of it from the original
  double distance() const;  ///< Hausdorff distance [m]: an upper bound, proven (surface_distance.h)
};
/// The fewest triangles, to a tenth, whose Hausdorff distance from `mesh` is up to `max_error` [m]; as closed as
/// `mesh`. The mesh itself if none has fewer.
TouchMesh touchMesh(const TriMesh& mesh, double max_error, const GoOn& go_on = {});
/// The distances of `made.mesh`, between bounds that differ by up to a tenth of `max_error`.
void measureTouchMesh(TouchMesh& made, const TriMesh& mesh, double max_error, const GoOn& go_on = {});

/// Convex pieces of a closed mesh, as solids.
struct TouchPieces {
  std::vector<TriMesh> pieces;  ///< empty: told to stop
  SurfaceDistance forth;        ///< of the mesh from the union of the pieces, as a solid
  SurfaceDistance back;         ///< of the pieces from the solid in the mesh
};
/// Up to `max_pieces` pieces; hollows of up to `max_error` [m] may be bridged. They are cut from a mesh of some
/// thousand triangles.
TouchPieces touchPieces(const TriMesh& mesh, std::size_t max_pieces, double max_error, const GoOn& go_on = {});

}  // namespace presa
