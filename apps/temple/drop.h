#pragma once
#include <string>
#include <vector>

#include "apps/temple/building/scene_text.h"

namespace presa::temple {

/// A lockstep run of stones with the scene's own dynamics, without anything seen or felt.
struct DropResult {
  std::vector<Pose> X_WB;     ///< of each stone, at the end
  std::vector<double> moved;  ///< of each, over the whole run: of its origin, and the turn times its reach [m]
  bool sound = true;          ///< the dynamics found nothing beyond reason
};
/// Starts from rest. `folder` has the meshes of meshFiles(…, true); a scene file is written there. Throws InputError.
DropResult drop(const Building& building, const std::vector<SceneSpec::Stone>& stones, double duration,
                const std::string& folder);

}  // namespace presa::temple
