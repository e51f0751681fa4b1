#pragma once
#include <algorithm>

#include "devices/percro_arm/dynamics.h"
#include "devices/percro_arm/encoders.h"
#include "devices/percro_arm/motors.h"

namespace presa::percro {

/// The whole arm as seen by its controller: force in, position by the encoders out, one period at a time. All in D. The
/// controller compensates the arm's weight, but not friction and inertia. Thread: haptic; nothing allocates.
class SimulatedArm {
 public:
  /// `gravity`: acceleration in D [m/s^2]; `period`: of the controller [s].
  SimulatedArm(const Parameters& parameters, const Vec3& gravity, double period);

  /// Puts the arm at rest with the tip at p_DT.
  void place(const Vec3& p_DT) noexcept;
  /// Sets the force on the finger [N], held until the next call. It passes through J^T and K^-T to the motors, which
  /// may limit it.
  void command(const Vec3& f_D) noexcept;
  /// Sets joint torques without weight compensation instead: for homing, while the arm's configuration is unknown.
  void commandJoints(const Vec3& torque) noexcept { drive_.command(to_motor_torque_ * torque, Vec3::Zero()); }
  /// Advances one period with this load at the tip.
  void advance(const TipLoad& load) noexcept;

  Vec3 reportedPosition() const noexcept;
  Vec3 reportedVelocity() const noexcept;
  Encoders& encoders() noexcept { return encoders_; }
  /// The true state, unknown to the encoders.
  const ArmState& state() const noexcept { return state_; }
  Vec3 tipForce() const noexcept { return dynamics_.tipForce(state_); }
  const ArmDynamics& dynamics() const noexcept { return dynamics_; }

  /// Max heat of a winding so far (1: at its limit); min share of a wanted force that the motors delivered.
  double maxHeat() const noexcept { return max_heat_; }
  double minShare() const noexcept { return min_share_; }

  static constexpr double kSubstep = 0.25e-3;  ///< max substep [s]: modes at 90 Hz have a frequency error of 0.2 %

 private:
  Parameters parameters_;
  ArmDynamics dynamics_;
  MotorDrive drive_;
  Encoders encoders_;
  Mat3 to_joint_torque_, to_motor_torque_;  // K^T, K^-T
  double period_;
  int substeps_;
  ArmState state_;
  double max_heat_ = 0, min_share_ = 1;
};

}  // namespace presa::percro
