#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "framework/scene/world.h"

namespace presa {

/// The signed distance of one body as a renderer of tools looks it up, for pictures (`--show field`). Thread: any, one at
/// a time; it changes nothing.
struct ToolField {
  std::int32_t body = kNoBody;  ///< index into Scene::bodies
  double voxel = 0;             ///< edge of its voxels; 0: exact [m]
  /// Of a point in body coordinates, negative inside; infinity where the renderer stores nothing [m].
  std::function<double(const Vec3& p_B)> distance;
};

}  // namespace presa
