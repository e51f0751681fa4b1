#pragma once
#include "framework/geometry/touch_mesh.h"

namespace presa::temple {

struct FeltMesh {
  TriMesh mesh;
  double distance = 0;  ///< Hausdorff distance from the original: an upper bound, in the mesh's unit
};
/// touchMesh, or its result of an earlier start: it is kept in the user's cache by the content of mesh and settings. A cache
/// that cannot be read or written is none. Thread: main.
FeltMesh feltMesh(const TriMesh& mesh, double max_error);

}  // namespace presa::temple
