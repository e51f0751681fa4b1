#pragma once
#include <optional>

#include "framework/scene/world.h"
#include "framework/state/object_state.h"

namespace presa::assembling {

/// Where two fingertips take a body: on a level line, pushing towards each other.
struct Grasp {
  Vec3 p_BC = Vec3::Zero();  ///< middle between the touched points, body frame [m]
  Vec3 a_B = Vec3::UnitX();  ///< from thumb to index, body frame
  double half = 0;           ///< half the width of the body there [m]
  double force = 0;          ///< of each finger [N]
  /// The body stands on its head, and would stay so: from this grasp it hangs on its side, to be put down and taken again.
  bool turns_over = false;
  double rest = 0;  ///< then: height of its centre over what it stands on, once it lies [m]
};

/// Half of what a physics geometry measures along the unit direction `n_G`, in its own frame [m].
double halfWidth(const Shape& shape, const TriMesh* mesh, const Vec3& n_G);

/// How to take body `i`, which is at X_WB and is to stand at X_WG. `yaw`: of the pair now, kept as far as may be [rad].
Grasp chooseGrasp(const World& world, std::size_t i, const Pose& X_WB, const Pose& X_WG, double yaw);

}  // namespace presa::assembling
