#pragma once
#include <assimp/scene.h>

#include "framework/geometry/mesh_import_plugin/mesh_reader.h"

namespace presa {

/// Materials and colours of the triangles of a scene that has been triangulated and whose indices are valid, in the
/// order in which readMesh gives the triangles.
void readAttributes(const aiScene& scene, RawAttributes& out);

}  // namespace presa
