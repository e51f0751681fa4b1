#pragma once
#include <string>

#include "framework/geometry/tri_mesh.h"

namespace presa {

/// The file of a mesh in Wavefront's format OBJ, coordinates to so many digits: nine keep every number of single
/// precision as it is. Thread: any.
std::string objText(const TriMesh& mesh, int digits = 8);

}  // namespace presa
