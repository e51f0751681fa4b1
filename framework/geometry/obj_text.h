#pragma once
#include <string>

#include "framework/geometry/tri_mesh.h"

namespace presa {

/// The file of a mesh in Wavefront's format OBJ, coordinates to eight digits. Thread: any.
std::string objText(const TriMesh& mesh);

}  // namespace presa
