#pragma once
#include "experiments/faults/fault.h"

/// Faults of what a scene is made from, in parts that sceneFaults() puts together.
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

/// A scene's fingers press what is between them for a moment; any number of roles, any rates. What was written must be finite and within
/// the scene's limits; the step is given as the share of the slew limit. Throws InputError.
void touchBriefly(const std::string& scene_file, double seconds, Outcome& outcome);

}  // namespace presa::faults
