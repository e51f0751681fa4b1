#pragma once
#include <cstdint>
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa::view {

/// A mesh ready for shading: a vertex is repeated where the surface has an edge.
struct ShadedMesh {
  std::vector<Eigen::Vector3f> positions;  ///< [m]
  std::vector<Eigen::Vector3f> normals;    ///< unit, outward
  std::vector<std::uint32_t> indices;      ///< three per triangle
};

/// Vertex normals, weighted by corner angle [Thuermer1998], over the neighbours whose faces turn by less than
/// `crease_angle` [rad]: round parts look round, edges stay sharp. Triangles without area are left out.
ShadedMesh shadeWithCreases(const TriMesh& mesh, double crease_angle);

}  // namespace presa::view
