#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/core/math/spatial.h"

namespace presa {

/// Indexed triangle mesh, counter-clockwise seen from outside [m].
struct TriMesh {
  using Triangle = std::array<std::int32_t, 3>;
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  /// Across edge (v[i], v[i+1]) of each triangle: index of the neighbour, -1 none. Filled by buildAdjacency.
  std::vector<Triangle> adjacency;
};

struct AxisBox {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
};
AxisBox boundsOf(const TriMesh& mesh);
/// Largest distance of a vertex from the origin [m].
double radiusOf(const TriMesh& mesh);
/// Enclosed volume [m^3] (negative: inside out), first moment / volume, and inertia about the centre of
/// mass for density 1 [kg m^2]: exact for a closed mesh (divergence theorem) [Mirtich1996].
struct MassProperties {
  double volume = 0;
  Vec3 center = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
};
MassProperties massProperties(const TriMesh& mesh);

/// Merges each vertex into the first earlier kept one not farther than `tolerance` [m], drops triangles that collapse by
/// it, returns vertices removed. Tolerance 0 merges equal ones. Deterministic; all indices must be valid.
std::size_t weld(TriMesh& mesh, double tolerance);
/// Removes vertices that no triangle names; returns how many.
std::size_t dropUnused(TriMesh& mesh);
/// Fills TriMesh::adjacency. An edge of one triangle or of more than two has no neighbour (-1).
void buildAdjacency(TriMesh& mesh);
/// Reverses every triangle (and the adjacency with it).
void turnInsideOut(TriMesh& mesh);

/// What a mesh is fit for. Counts of what is wrong; all zero: a closed, consistently oriented surface.
struct MeshReport {
  std::size_t vertices = 0, triangles = 0;
  std::size_t non_finite = 0;     ///< vertices with NaN or infinity
  std::size_t bad_index = 0;      ///< triangles naming a vertex that does not exist
  std::size_t degenerate = 0;     ///< triangles without area (relative to their longest edge)
  std::size_t non_manifold = 0;   ///< edges of more than two triangles
  std::size_t open_edges = 0;     ///< edges of one triangle
  std::size_t flipped_edges = 0;  ///< edges whose two triangles disagree about outside
  bool inverted = false;          ///< closed, but inside out
  bool closed() const { return open_edges == 0 && non_manifold == 0; }
};
MeshReport checkMesh(const TriMesh& mesh);

/// Triangulations of the primitives, closed, centred at the origin; chord error below 0.12 % of the radius.
TriMesh makeBox(const Vec3& size);
TriMesh makeSphere(double radius, int subdivisions = 4);
TriMesh makeCylinder(double radius, double length, int segments = 96);
TriMesh makeCapsule(double radius, double length, int segments = 104);

/// Reads OBJ, STL, PLY, glTF/GLB or COLLADA through the mesh-import plug-in (assimp), which is loaded at the first call;
/// scales, welds (tolerance: 1e-6 of the diagonal), drops what is degenerate, checks, and builds adjacency.
/// Findings (missing file, empty, NaN, degenerate, non-manifold, open, inverted) go to `diagnostics` at `where`; an
/// inverted closed mesh is turned with a warning; few degenerate triangles are dropped with a warning.
/// Axes and units: OBJ, STL and PLY state none and are taken as metres, z up. glTF is metres, y up by its standard, and
/// COLLADA states both: they are turned and scaled to metres, z up. Coordinates pass through single precision (assimp).
/// Thread: any, not the haptic group. Never throws for bad input: the result is empty when an error was reported.
struct ImportOptions {
  bool must_be_closed = true;  ///< false: an open mesh is a warning
  bool display_only = false;   ///< topology does not matter: open, non-manifold or degenerate is no finding
  Vec3 scale = Vec3::Ones();   ///< a negative factor mirrors (the triangles are turned with it)
};
TriMesh importMesh(const std::string& file, const ImportOptions& options, const SourceLocation& where,
                   Diagnostics& diagnostics);

}  // namespace presa
