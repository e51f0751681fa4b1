#pragma once
#include "framework/scene/world.h"

namespace presa::ode {

/// For a run in real time: throws InputError E272 where a free body and another one would be collided as meshes by ODE,
/// which the haptic thread cannot do beside the dynamics (`collide`, engine.h).
void refuseMeshesOfOde(const World& world);

}  // namespace presa::ode
