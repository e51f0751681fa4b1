#pragma once
#include <memory>

#include "devices/hand/motion.h"

namespace presa {

/// Pushes a fingertip along a motion: position control across the grip, force control along it. Both corrections are
/// slow like a human hand, far below the contact dynamics. Frame W. Thread: haptic; nothing allocates.
class ScriptedHand {
 public:
  /// `stiffness`: of the hand [N/m].
  ScriptedHand(std::unique_ptr<Motion> motion, double stiffness) : motion_(std::move(motion)), stiffness_(stiffness) {}

  /// Computes one period from `time` on, for a fingertip at p_WH under the device force `felt` [N]. Adds the hand's
  /// forces other than its spring to `force` and returns the target of the spring.
  MotionTarget live(double time, double period, const Vec3& p_WH, const Vec3& felt, Vec3& force) noexcept;
  const Motion& motion() const { return *motion_; }

 private:
  std::unique_ptr<Motion> motion_;
  double stiffness_;
  double grip_ = 0;            // [N] correction of the grip force
  Vec3 carry_ = Vec3::Zero();  // [N] correction that carries the load
};

}  // namespace presa
