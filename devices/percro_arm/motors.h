#pragma once
#include "devices/percro_arm/parameters.h"
#include "framework/core/math/spatial.h"

namespace presa::percro {

/// Three motors with their current loops and the heat in their windings. Torques at the motor shafts [N m].
/// The current follows its command with a lag of first order. Heat is the share of the allowed rise of temperature, first
/// order in the square of the torque: heat' = ((T / continuous)^2 - heat) / thermal_time. A cool motor gives its peak, one in
/// its last tenth less and less, a hot one its continuous torque. Thread: haptic; nothing allocates.
class MotorDrive {
 public:
  explicit MotorDrive(const Motors& motors) : motors_(motors) {}

  /// Sets the command to `carried` + s `wanted`, s in [0, 1] the largest that no motor's limit forbids: a force keeps its
  /// direction. Returns s.
  double command(const Vec3& carried, const Vec3& wanted) noexcept;
  /// Over the next h: the mean torque, exact for a held command. Heats the windings with it.
  Vec3 step(double h) noexcept;

  /// What each motor may give now.
  Vec3 limits() const noexcept;
  const Vec3& heat() const noexcept { return heat_; }

 private:
  Motors motors_;
  Vec3 command_ = Vec3::Zero(), torque_ = Vec3::Zero(), heat_ = Vec3::Zero();
};

}  // namespace presa::percro
