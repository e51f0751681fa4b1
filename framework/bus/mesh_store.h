#pragma once
#include <string>
#include <vector>

#include "framework/bus/samples.h"
#include "framework/core/diagnostics/diagnostics.h"
#include "framework/scene/scene.h"

namespace presa::bus {

/// Value of RunInfo::mesh_sums for a scene. A mesh that cannot be read gets zeros, which match no file.
std::string sumsOfMeshes(const Scene& scene);

/// Replaces the meshes of a run's scene (parsed from RunInfo::scene_xml) by files of this machine: those in or below
/// `folders` whose bytes have the checksums that the run sent. No path received over the bus is opened, only regular
/// files with a mesh extension in those folders. Reports E755 for each mesh that is not found and leaves its path
/// empty; so it does with the files that elements of plug-ins name, which a viewer does not need.
void takeFromMeshStore(Scene& scene, const RunInfo& run, const std::vector<std::string>& folders,
                       Diagnostics& diagnostics);

}  // namespace presa::bus
