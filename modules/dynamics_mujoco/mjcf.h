#pragma once
#include <string>

#include "framework/scene/world.h"

namespace presa::mujoco {

/// The scene as MuJoCo XML: bodies in scene order with their names and inertia, geometries with their friction, time
/// step `step` [s]. Throws InputError (E580) for a mesh as physics geometry.
std::string mjcfOf(const World& world, double step);

}  // namespace presa::mujoco
