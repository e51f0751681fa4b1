#pragma once
#include <cstdint>
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa::view {

/// A mesh prepared for shading: vertices are duplicated along sharp edges.
struct ShadedMesh {
  std::vector<Eigen::Vector3f> positions;  ///< [m]
  std::vector<Eigen::Vector3f> normals;    ///< unit, outward
  std::vector<std::uint32_t> indices;      ///< three per triangle
};

/// The normals of shadeWithCreases for each corner of each triangle, three for one; zero where a triangle has no area.
std::vector<Eigen::Vector3f> cornerNormals(const TriMesh& mesh, double crease_angle);

/// Vertex normals weighted by corner angle [Thuermer1998], averaged over neighbours whose faces differ by less than
/// `crease_angle` [rad]: curved parts appear smooth, edges stay sharp. Triangles without area are omitted.
ShadedMesh shadeWithCreases(const TriMesh& mesh, double crease_angle);

}  // namespace presa::view
