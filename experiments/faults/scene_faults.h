#pragma once
#include "experiments/faults/fault.h"

/// The families of sceneFaults(): faults of scene files, meshes and bodies.
namespace presa::faults {

Outcome malformedScene(RandomStream& random);
Outcome entityBomb(RandomStream& random);
Outcome corruptMesh(RandomStream& random);
Outcome bodyRunsAway(RandomStream& random);
Outcome bodyStruck(RandomStream& random);
Outcome overloadedDynamics(RandomStream& random);

/// Faults of the machine and of the rig.
Outcome wallClockJumps(RandomStream& random);
Outcome standsStill(RandomStream& random);
Outcome realTimeRefused(RandomStream& random);
Outcome tooStiff(RandomStream& random);

/// The fingers of a scene, one per role, briefly move into its middle; works for any roles and rates. Requires finite
/// forces within the scene's limits; the step of the outcome is relative to the slew limit. Throws InputError.
void touchBriefly(const std::string& scene_file, double seconds, Outcome& outcome);

}  // namespace presa::faults
