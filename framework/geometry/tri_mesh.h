#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/core/math/spatial.h"

namespace presa {

/// Indexed triangle mesh [m]. Triangles are counter-clockwise seen from outside.
struct TriMesh {
  using Triangle = std::array<std::int32_t, 3>;  ///< three indices into `vertices`, or into `triangles` for `adjacency`
  std::vector<Vec3> vertices;                    ///< [m]
  std::vector<Triangle> triangles;               ///< counter-clockwise seen from outside
  /// Neighbour across edge (v[i], v[(i+1)%3]) of each triangle: a triangle index, or -1. Filled by buildAdjacency.
  std::vector<Triangle> adjacency;
};

/// Axis-aligned box [m]; the default is empty.
struct AxisBox {
  Vec3 low = Vec3::Constant(1e300),   ///< smallest coordinates
      high = Vec3::Constant(-1e300);  ///< largest coordinates; below `low`: empty
};
AxisBox boundsOf(const TriMesh& mesh);  ///< box of all vertices
/// Largest distance of a vertex from the origin [m].
double radiusOf(const TriMesh& mesh);
/// Volume [m^3] (negative: inside out), centre of mass, and inertia about the centre of mass for density 1 kg/m^3
/// [kg m^2], in mesh axes. Exact for a closed mesh (divergence theorem) [Mirtich1996].
struct MassProperties {
  double volume = 0;            ///< [m^3]; negative: inside out
  Vec3 center = Vec3::Zero();   ///< centre of mass [m]
  Mat3 inertia = Mat3::Zero();  ///< about `center`, in mesh axes, for 1 kg/m^3 [kg m^2]
};
MassProperties massProperties(const TriMesh& mesh);  ///< zero for no triangles; no inertia for no volume

/// Merges each vertex into the first kept vertex within `tolerance` [m] and drops triangles that collapse. Returns the
/// number of vertices removed. Tolerance 0 merges equal vertices. Deterministic; all indices must be valid.
std::size_t weld(TriMesh& mesh, double tolerance);
/// Removes vertices that no triangle uses; returns their number.
std::size_t dropUnused(TriMesh& mesh);
/// Fills TriMesh::adjacency. An edge of one triangle or of more than two has no neighbour (-1).
void buildAdjacency(TriMesh& mesh);
/// Reverses the orientation of every triangle and updates the adjacency.
void turnInsideOut(TriMesh& mesh);

/// Result of checkMesh: counts of defects. All zero: a closed, consistently oriented surface.
struct MeshReport {
  std::size_t vertices = 0,       ///< of the mesh: no defect
      triangles = 0;              ///< of the mesh: no defect
  std::size_t non_finite = 0;     ///< vertices with NaN or infinity
  std::size_t bad_index = 0;      ///< triangles naming a vertex that does not exist
  std::size_t degenerate = 0;     ///< triangles without area (relative to their longest edge)
  std::size_t non_manifold = 0;   ///< edges of more than two triangles
  std::size_t open_edges = 0;     ///< edges of one triangle
  std::size_t flipped_edges = 0;  ///< edges whose two triangles disagree about outside
  bool inverted = false;          ///< closed, but inside out
  bool closed() const { return open_edges == 0 && non_manifold == 0; }  ///< each edge has two triangles
};
MeshReport checkMesh(const TriMesh& mesh);  ///< needs no adjacency; changes nothing
/// MeshReport::degenerate alone.
std::size_t degenerateTriangles(const TriMesh& mesh);

/// Triangulations of the primitives, closed, centred at the origin; chord error below 0.12 % of the radius.
TriMesh makeBox(const Vec3& size);
TriMesh makeSphere(double radius, int subdivisions = 4);  ///< each splits a triangle of an icosahedron into four
TriMesh makeCylinder(double radius, double length, int segments = 96);  ///< axis z
TriMesh makeCapsule(double radius, double length, int segments = 104);  ///< axis z; `length` without the caps

/// How importMesh reads a file.
struct ImportOptions {
  bool must_be_closed = true;  ///< false: an open mesh is a warning
  bool display_only = false;   ///< for drawing only: open, non-manifold and degenerate meshes are accepted silently
  Vec3 scale = Vec3::Ones();   ///< per axis [-]; a negative factor mirrors, and the triangles are flipped accordingly
};
/// Reads OBJ, STL, PLY, glTF/GLB or COLLADA through the mesh-import plug-in (assimp), which is loaded at the first
/// call. Scales, welds (tolerance: 1e-6 of the bounding-box diagonal), drops degenerate triangles, checks, builds the
/// adjacency. Findings go to `diagnostics` at `where` (numbers: README.md). A closed mesh that is inside out is
/// corrected and fewer than ten degenerate triangles are dropped, each with a warning.
/// Axes and units: OBJ, STL and PLY state none and are read as metres, z up. glTF (metres, y up) and COLLADA (both
/// stated in the file) are converted to metres, z up. Coordinates pass through single precision (assimp).
/// Thread: any, not the haptic group. Never throws for bad input: the result is empty when an error was reported.
TriMesh importMesh(const std::string& file, const ImportOptions& options, const SourceLocation& where,
                   Diagnostics& diagnostics);

}  // namespace presa
