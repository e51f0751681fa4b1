#pragma once
#include <vector>

#include "framework/haptics/body_effects.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/sleep.h"

namespace presa::ode {

/// Applies the wrenches of body effects implicitly: with the rates d and k (framework/haptics/body_effect.h) the step
///   m (v1 - v0) = h (f - d (v1 - v0) - k h v1 + m g + rest)
/// is that of a body of the mass m + h d + h^2 k under the force f - h k v0 + m g + rest. The solver of contacts and fingers gets that mass,
/// so their forces meet the same resistance in the same step.
class BodyEffectForces {
 public:
  /// `effects` must outlive it.
  BodyEffectForces(BodyEffects& effects, const World& world);

  /// Call before a step: wakes sleeping bodies on which the wrench changes. `sleep` may be null.
  void wakeStirred(BodySet& bodies, Sleep* sleep, double time, double period);
  /// Call in each sub-step, after BodySet::resetForces.
  void push(BodySet& bodies, double time, double h);

  bool broken() const noexcept { return effects_.broken(); }

 private:
  struct Rest {
    bool known = false;
    Vec3 f_W = Vec3::Zero(), torque_W = Vec3::Zero();
  };
  template <class Wanted>
  void sumUp(const BodySet& bodies, double time, double h, const Wanted& wanted);
  void add(std::size_t effect, const BodySet& bodies, std::size_t body, double time, double h);

  BodyEffects& effects_;
  Vec3 gravity_W_;
  std::vector<BodyEffectWrench> sums_;  // by body
  std::vector<Rest> rest_;              // by body: what acted in the last step asleep
};

}  // namespace presa::ode
