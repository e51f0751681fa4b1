#pragma once
#include <string>
#include <vector>

#include "apps/temple/building/scene_text.h"

namespace presa::temple {

/// Result of a drop: a lockstep run of stones with the scene's own dynamics, without graphics and haptics.
struct DropResult {
  std::vector<Pose> X_WB;     ///< final pose of each stone
  std::vector<double> moved;  ///< displacement of each: of its origin, plus rotation times radius [m]
  bool sound = true;          ///< the dynamics reported no fault
};
/// Runs `duration` [s] from rest. `folder` must hold the meshes of meshFiles(…, true); the scene file is written there.
/// Throws InputError.
DropResult drop(const Building& building, const std::vector<SceneSpec::Stone>& stones, double duration,
                const std::string& folder);

}  // namespace presa::temple
