#pragma once
#include "framework/core/state/object_state.h"

namespace presa::ode {

/// A body's way from the pose and velocities that the haptic thread gave it to those of the dynamics, without a step in
/// either: the offset between the two, with its rate, goes to zero along a cubic within kTime.
class GentleReturn {
 public:
  static constexpr double kTime = 0.05;  // [s]

  GentleReturn() = default;
  /// Both states at `time` [s]; the poses at their ends.
  GentleReturn(const BodyMotion& from, const BodyMotion& to, double time);
  /// The body at `time`, when the dynamics have it at `to`.
  BodyMotion at(const BodyMotion& to, double time) const;
  bool isOver(double time) const noexcept { return time >= begin_ + kTime; }

 private:
  double begin_ = 0;
  Vec3 p_ = Vec3::Zero(), v_ = Vec3::Zero();  // offset of the origin and its rate
  Vec3 turn_ = Vec3::Zero(), w_ = Vec3::Zero();
};

}  // namespace presa::ode
