#pragma once
#include "framework/session/load_world.h"

namespace presa::check {

/// Warns of what a scene that loads well may still mean wrong, each with a figure and a cure: W241 bodies that overlap at
/// the start, W242 a mesh, or a body that moves, as large as if its millimetres were metres, W243 fingers of models that start far from every
/// body; and as warnOfExplicitGrasps. Thread: main, before a run.
void warnOfStart(const Loaded& loaded, Diagnostics& diagnostics);

/// W245 for each grasp whose body is too light for an explicit exchange of forces (apps/common/grasp_loop.h). Thread:
/// main.
void warnOfExplicitGrasps(const World& world, Diagnostics& diagnostics);

/// W244, if the dynamics need longer for a step than its period and bodies have meshes as their physics. Measures
/// `simulated` seconds in lockstep; only for scenes with such a mesh and fingers of models alone.
void warnOfSlowMeshes(Loaded loaded, double simulated, Diagnostics& diagnostics);
/// The same for a measured step [s].
void warnOfSlowMeshes(const World& world, double step, Diagnostics& diagnostics);

}  // namespace presa::check
