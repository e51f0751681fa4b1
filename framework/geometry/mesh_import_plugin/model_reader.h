#pragma once
#include <assimp/scene.h>

#include "framework/geometry/mesh_import_plugin/mesh_reader.h"

namespace presa {

/// Colours, texture coordinates and materials of a scene that has been triangulated and whose indices are valid; nothing
/// if it says nothing about colours. `z_up`: turn y to z. Sources: the file's format; materials as [glTF 2.0 3.9].
void readModel(const aiScene& scene, const std::string& extension, bool z_up, RawModel& out);

}  // namespace presa
