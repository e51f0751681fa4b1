#pragma once
#include "framework/assembly/assembly_state.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/scene.h"

namespace presa {

/// Estimates the assembly state from poses and velocities alone: filled goals, and fitting bodies near unfilled ones.
/// Has no memory, so the order of filling, actual snap pulls and bodies carried back are unknown.
AssemblyState standing(const Assembly& assembly, const ObjectState& objects);

}  // namespace presa
