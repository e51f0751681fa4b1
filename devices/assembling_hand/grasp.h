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
  /// A flat body on its head, whose top is out of reach: it hangs on its side from this grasp, to be put down where it is and taken again.
  bool lays_down = false;
  double rise = 0;  ///< then: of its centre, from standing to lying [m]
};

/// Half of what a physics geometry measures along the unit direction `n_G`, in its own frame [m].
double halfWidth(const Shape& shape, const TriMesh* mesh, const Vec3& n_G);

/// How to take body `i`, which is at X_WB and is to stand at X_WG. `yaw`: of the pair now, kept as far as may be [rad].
Grasp chooseGrasp(const World& world, std::size_t i, const Pose& X_WB, const Pose& X_WG, double yaw);

}  // namespace presa::assembling
