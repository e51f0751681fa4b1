#pragma once
#include "framework/geometry/tri_mesh.h"

namespace presa::temple {

/// A standing person in a belted gown, `height` tall [m]: a closed surface, feet at z = 0, facing -y.
TriMesh makeFigure(double height);

}  // namespace presa::temple
