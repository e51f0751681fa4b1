#pragma once
#include <vector>

#include "framework/core/state/object_state.h"
#include "framework/scene/scene.h"
#include "modules/dynamics_ode/finger_joints.h"
#include "modules/dynamics_ode/owed_impulses.h"

namespace presa::ode {

/// What the fingers gave to the bodies, what was owed to them included: the mean force of the last step by finger, the
/// impulse since the start by finger, and the impulse by finger and body since the finger came to that body.
class FingerImpulses {
 public:
  explicit FingerImpulses(const Scene& scene);
  /// Makes room for more fingers than the scene has.
  void makeRoom(std::size_t fingers);
  /// Starts a step at `time` [s].
  void begin(double time);
  /// Adds the contacts of a solved sub-step of `h` [s], one of `substeps`.
  void add(const FingerJoints& joints, double h, int substeps);
  /// Adds what the step gives of what is owed, over `period` [s].
  void add(const OwedImpulses& owed, double period);
  /// Forgets the contacts that the step no longer had.
  void end();
  void setForcesToZero();

  Vec3 force(std::size_t finger) const { return force_[finger]; }
  void write(ObjectState& out) const;

 private:
  void touch(std::size_t finger, std::size_t body, const Vec3& impulse_W);

  std::size_t bodies_per_finger_;
  double time_ = 0;
  std::vector<Vec3> force_, impulse_;  // by finger
  BoundedList<FingerImpulse> touches_;
  std::vector<char> renewed_;  // as touches_
};

}  // namespace presa::ode
