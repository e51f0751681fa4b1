#pragma once
#include <optional>

#include "framework/geometry/distance_field.h"
#include "framework/geometry/tri_mesh.h"

namespace presa {

/// The field of a mesh with adjacency, a closed one or, with a `thickness` [m] > 0, a shell of what lies within half of
/// it: from the user's cache (framework/input/cache.h) by the content of mesh and settings, or built and, if that took
/// long, kept there. A cache that cannot be read or is damaged is none. None: told to stop, or larger than
/// settings.max_bytes; `size` then says by how much. Thread: before a run.
std::optional<DistanceField> cachedField(const TriMesh& mesh, double thickness, const DistanceField::Settings& settings,
                                         DistanceField::Size& size);

}  // namespace presa
