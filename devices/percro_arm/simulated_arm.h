#pragma once
#include <algorithm>

#include "devices/percro_arm/dynamics.h"
#include "devices/percro_arm/encoders.h"
#include "devices/percro_arm/motors.h"

namespace presa::percro {

/// The whole arm as its controller meets it: force in, position as the encoders tell it out, one period at a time. All in D.
/// The controller carries the arm's weight; friction and inertia it leaves to the finger. Thread: haptic; nothing allocates.
class SimulatedArm {
 public:
  /// `gravity`: acceleration in D [m/s^2]; `period`: of the controller [s].
  SimulatedArm(const Parameters& parameters, const Vec3& gravity, double period);

  /// At rest with the tip there.
  void place(const Vec3& p_DT) noexcept;
  /// The force wanted on the finger from now on [N]. Through J^T and K^-T to the motors, which may give less.
  void command(const Vec3& f_D) noexcept;
  /// Joint torques instead, weight and all: for homing, while the arm does not know how it stands.
  void commandJoints(const Vec3& torque) noexcept { drive_.command(to_motor_torque_ * torque, Vec3::Zero()); }
  /// One period with this at the tip.
  void advance(const TipLoad& load) noexcept;

  Vec3 reportedPosition() const noexcept;
  Vec3 reportedVelocity() const noexcept;
  Encoders& encoders() noexcept { return encoders_; }
  /// The truth, which no encoder knows.
  const ArmState& state() const noexcept { return state_; }
  Vec3 tipForce() const noexcept { return dynamics_.tipForce(state_); }
  const ArmDynamics& dynamics() const noexcept { return dynamics_; }

  /// Hottest winding so far, 1: as hot as it may be; and the least part of a wanted force that the motors gave.
  double mostHeat() const noexcept { return most_heat_; }
  double leastShare() const noexcept { return least_share_; }

  static constexpr double kSubstep = 0.25e-3;  ///< at most [s]: 90 Hz modes with 0.2 % of frequency error

 private:
  Parameters parameters_;
  ArmDynamics dynamics_;
  MotorDrive drive_;
  Encoders encoders_;
  Mat3 to_joint_torque_, to_motor_torque_;  // K^T, K^-T
  double period_;
  int substeps_;
  ArmState state_;
  double most_heat_ = 0, least_share_ = 1;
};

}  // namespace presa::percro
