#pragma once
#include "framework/bus/samples.h"
#include "framework/scene/world.h"

/// The frames of a run's rig as a viewer needs them: which there are, and what stands in which.
namespace presa::bus {

/// Of the run's end, for its RunInfo.
std::vector<RigFrame> rigFrames(const Rig& rig);
/// Frame in which the device of each role of the scene stands. Empty in a rig without frames.
std::vector<std::string> placesOf(const World& world);
/// Of the viewer's end: a rig with these frames, that drives nothing.
Rig rigOf(const RunInfo& run, const Scene& scene);

}  // namespace presa::bus
