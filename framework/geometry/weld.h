#pragma once
#include <cstdint>
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa {

/// weld (tri_mesh.h). `kept`: gets the index that each remaining triangle had before, in ascending order; may be null.
std::size_t weld(TriMesh& mesh, double tolerance, std::vector<std::int32_t>* kept);

}  // namespace presa
