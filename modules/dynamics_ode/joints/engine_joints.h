#pragma once
#include <ode/ode.h>

#include <vector>

#include "framework/scene/world.h"
#include "modules/dynamics_ode/body_set.h"

namespace presa::ode {

/// The joints of a scene as ODE has them, for its own solvers: fixed, hinge, slider and ball, with stops, and a motor or
/// friction. The methods to compare with; E235 refuses what they lack.
class EngineJoints {
 public:
  /// Owns joints in `ode_world`: destroy it before `ode_world`.
  EngineJoints(const World& world, const BodySet& bodies, dWorldID ode_world);
  ~EngineJoints();
  EngineJoints(const EngineJoints&) = delete;
  EngineJoints& operator=(const EngineJoints&) = delete;

 private:
  std::vector<dJointID> joints_;
};

}  // namespace presa::ode
