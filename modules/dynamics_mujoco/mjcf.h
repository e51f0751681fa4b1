#pragma once
#include <string>

#include "framework/scene/world.h"

namespace presa::mujoco {

/// The scene as a model in MuJoCo's XML: a body per free body with its inertia, geometries with their friction, time step
/// `step` [s]. Bodies stand in scene order and bear their names. Throws InputError (E580) for a mesh as physics geometry.
std::string mjcfOf(const World& world, double step);

}  // namespace presa::mujoco
