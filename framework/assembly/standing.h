#pragma once
#include "framework/scene/scene.h"
#include "framework/assembly/assembly_state.h"
#include "framework/core/state/object_state.h"

namespace presa {

/// What stands in its place and what is near one that has to wait, from poses and velocities alone. It has no memory: what is being
/// drawn, what came last and what is brought back it does not know.
AssemblyState standing(const Assembly& assembly, const ObjectState& objects);

}  // namespace presa
