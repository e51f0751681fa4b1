#pragma once
#include <string>
#include <vector>

#include "framework/bus/samples.h"
#include "framework/core/diagnostics/diagnostics.h"
#include "framework/scene/scene.h"

namespace presa::bus {

/// RunInfo::mesh_sums of a scene whose meshes are files. One that cannot be read gets zeros, which no viewer finds.
std::string sumsOfMeshes(const Scene& scene);

/// Lets the meshes of a run's scene, as parsed from RunInfo::scene_xml, be files of this machine: those in `folders` and below whose bytes
/// have the sums that the run names. No path that came over the bus is opened, only regular files with a mesh's ending in
/// those folders. Reports E755 for each mesh that is not there; then its path is empty.
void takeFromShelf(Scene& scene, const RunInfo& run, const std::vector<std::string>& folders, Diagnostics& diagnostics);

}  // namespace presa::bus
