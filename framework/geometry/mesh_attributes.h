#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa {

/// Attributes of a mesh file, in the order of the triangles of importMesh.
struct MeshAttributes {
  /// Names of the materials that triangles have (OBJ usemtl, glTF and COLLADA materials), in the triangles' order.
  /// Faces of an OBJ file before its first usemtl are of that material.
  std::vector<std::string> parts;
  std::vector<std::int32_t> part_of;  ///< by triangle: index into `parts`; -1: of no named material
  /// By triangle and corner: grey value of the vertex colour, 0 black, 1 white: 0.2126 red + 0.7152 green + 0.0722 blue
  /// of the numbers in the file (PLY, OBJ, glTF COLOR_0, COLLADA). 1 for a part without colours; empty: the file has
  /// none.
  std::vector<std::array<float, 3>> corner_grey;
};

/// Result of importAttributed.
struct AttributedMesh {
  TriMesh mesh;               ///< as by importMesh; empty after an error
  MeshAttributes attributes;  ///< of `mesh`
};

/// importMesh (tri_mesh.h), and the attributes in the same file; a mesh that was turned inside out or lost degenerate
/// triangles has its attributes turned and lost alike. Thread: any, not the haptic group. Errors as importMesh.
AttributedMesh importAttributed(const std::string& file, const ImportOptions& options, const SourceLocation& where,
                                Diagnostics& diagnostics);

}  // namespace presa
