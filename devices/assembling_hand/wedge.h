#pragma once
#include <optional>

#include "devices/assembling_hand/grasp.h"

namespace presa::assembling {

/// Grasp of body `i`, a convex mesh lying on its side, such that it swings its top `up_B` up. The line is level and as
/// far above the centre of mass as both fingertips find faces on which they do not slip; a wedge then hangs slightly
/// askew. Nullopt when there is no such line or the body is no mesh.
std::optional<Grasp> graspOfLyingMesh(const World& world, std::size_t i, const Pose& X_WB, const Vec3& up_B,
                                      double yaw);

}  // namespace presa::assembling
