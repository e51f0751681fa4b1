#pragma once
#include "devices/percro_arm/parameters.h"
#include "framework/core/math/spatial.h"

namespace presa::percro {

/// Three motors with their current loops and winding temperatures. Torques at the motor shafts [N m]. The torque
/// follows its command with a first-order lag. Heat is the temperature rise relative to its limit: heat' = ((T /
/// continuous)^2 - heat) / thermal_time. The torque limit is the peak torque up to a heat of 0.9, then falls to the
/// continuous torque at a heat of 1. Thread: haptic; nothing allocates.
class MotorDrive {
 public:
  explicit MotorDrive(const Motors& motors) : motors_(motors) {}

  /// Sets the command to `carried` + s `wanted`, with the largest s in [0, 1] within the limits of all motors, so that
  /// a force keeps its direction. Returns s.
  double command(const Vec3& carried, const Vec3& wanted) noexcept;
  /// Advances by h [s] and returns the mean torque, exact for a held command; heats the windings.
  Vec3 step(double h) noexcept;

  /// Current torque limit of each motor.
  Vec3 limits() const noexcept;
  const Vec3& heat() const noexcept { return heat_; }

 private:
  Motors motors_;
  Vec3 command_ = Vec3::Zero(), torque_ = Vec3::Zero(), heat_ = Vec3::Zero();
};

}  // namespace presa::percro
