#pragma once
#include <memory>

#include "devices/hand/motion.h"

namespace presa {

/// Pushes a fingertip along a motion. Across the grip it keeps its place, along the grip it keeps its force; both corrections
/// are slow, as a hand's are, far below the contact's dynamics. Thread: haptic; nothing allocates.
class ScriptedHand {
 public:
  /// `stiffness`: of the hand's spring [N/m].
  ScriptedHand(std::unique_ptr<Motion> motion, double stiffness) : motion_(std::move(motion)), stiffness_(stiffness) {}

  /// One period from `time` on, the fingertip at p_WH, the device pushing it by `felt`. Adds to `force` what the hand does
  /// beside its spring; returns where that spring pulls.
  MotionTarget live(double time, double period, const Vec3& p_WH, const Vec3& felt, Vec3& force) noexcept;
  const Motion& motion() const { return *motion_; }

 private:
  std::unique_ptr<Motion> motion_;
  double stiffness_;
  double grip_ = 0;            // [N] beyond the wanted grip
  Vec3 carry_ = Vec3::Zero();  // [N] that carries the load
};

}  // namespace presa
