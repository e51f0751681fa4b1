#pragma once
#include <vector>

#include "framework/haptics/effect_reactions.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/sleep.h"

namespace presa::ode {

/// Turns the summed impulses of force effects into forces for one step. An impulse reaches its body one step late, whole:
/// the mean force over the step is the increment of the impulse divided by the period.
class EffectForces {
 public:
  /// Allocates for so many bodies. Not called: the first steps allocate.
  void makeRoom(std::size_t bodies);
  /// Call before a step of `period` [s]; `sleep` may be null. Wakes the bodies that got an impulse.
  void read(const EffectReactions& reactions, double period, BodySet& bodies, Sleep* sleep);
  /// Call in each sub-step, after BodySet::resetForces.
  void push(BodySet& bodies) const;

 private:
  struct Force {
    std::size_t body;
    Vec3 f_W, torque_W;  ///< torque about the origin of B
  };
  std::vector<EffectReactions::OnBody> given_;  ///< impulses up to the last step
  std::vector<Force> forces_;
};

}  // namespace presa::ode
