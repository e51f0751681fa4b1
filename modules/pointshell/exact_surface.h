#pragma once
#include "framework/geometry/point_shell.h"
#include "framework/scene/scene.h"

namespace presa {

/// Moves points of a tool's triangles, in T, onto the sphere, cylinder or capsule that the triangles approximate, and
/// their normals likewise: the tool is round, whatever its triangulation. Of another shape: none, its triangles are
/// exact. Thread: before a run.
PointShell::Exact exactSurfaceOf(const Geometry& tool);

}  // namespace presa
