#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa::test {

/// Reads an OFF file: plain, COFF or NOFF, comments anywhere, polygons cut into fans. Throws std::runtime_error.
TriMesh readOff(const std::filesystem::path& file);
/// Moves the middle of the bounding box to the origin and makes its largest side `size` [m].
void scaleTo(TriMesh& mesh, double size);
void writeObj(const TriMesh& mesh, const std::filesystem::path& file);

/// Path of a mesh of Debian's libcgal-demo or assimp-testmodels. Throws std::runtime_error naming the package to
/// install if it is missing.
std::filesystem::path packagedMesh(const std::string& name);

/// The twenty meshes that fingers wander over: closed or nearly, folded, thin, coarse and fine.
const std::vector<std::string>& realMeshes();
/// One of them: welded, without degenerate triangles, 0.15 m large, with adjacency; reoriented if it is inside out.
TriMesh realMesh(const std::string& name);

}  // namespace presa::test
