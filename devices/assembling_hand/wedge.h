#pragma once
#include <optional>

#include "devices/assembling_hand/grasp.h"

namespace presa::assembling {

/// How to take body `i`, a convex mesh that lies on its side, so that it swings its top `up_B` up: level, as far above the centre of mass as
/// leaves both fingertips a face that they do not slip from; a wedge hangs a little askew then. Nothing when there is no such line.
std::optional<Grasp> graspOfLyingMesh(const World& world, std::size_t i, const Pose& X_WB, const Vec3& up_B,
                                      double yaw);

}  // namespace presa::assembling
