#pragma once
#include <vector>

#include "framework/scene/world.h"

namespace presa::temple {

/// Half extents of a block's physics shape in its body frame.
struct BlockShape {
  Vec3 half = Vec3::Zero();  ///< [m]; zero: not a block that fingers take
  bool round = false;        ///< a cylinder about the body's z axis
};
/// By body of the scene; fixed bodies have none.
std::vector<BlockShape> blockShapes(const World& world);

/// How two fingertips on a level line take a block.
struct GraspAim {
  Vec3 p_W = Vec3::Zero();  ///< middle between the fingertips: on the block's axis, above its centre [m]
  double yaw = 0;           ///< of the line thumb to index, across two of its faces; nearest to the wanted one [rad]
  double half = 0;          ///< half of its width along the line [m]
  double top = 0;           ///< its highest point above the ground [m]
  double bottom = 0;        ///< its lowest [m]
};
/// `yaw`: wanted direction [rad]; `fingertip`: radius of the fingertips, which stay above the ground by it [m]. Thread:
/// any; no allocation.
GraspAim aimAt(const BlockShape& shape, const Pose& X_WB, double yaw, double fingertip) noexcept;

}  // namespace presa::temple
