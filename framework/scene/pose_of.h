#pragma once
#include "framework/core/state/object_state.h"
#include "framework/scene/scene.h"

namespace presa {

/// Pose X_WB of a body at `time` [s]: that of the newest Object State, or, before the first one and without dynamics,
/// that of the scene. `newest` may be null.
inline Pose poseOf(const Scene& scene, const ObjectState* newest, std::int32_t body, double time) {
  if (newest != nullptr && body < newest->count()) return newest->poseAt(body, time);
  return scene.bodies[static_cast<std::size_t>(body)].X_WB;
}

}  // namespace presa
