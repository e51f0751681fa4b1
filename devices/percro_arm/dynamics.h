#pragma once
#include "devices/percro_arm/kinematics.h"

/// Motion of the arm and of what holds its tip. The encoders see the joints; the tip is tied to them by the springs of the
/// structure, which are in the barrel's frame: stiff along it, [Bergamasco2006 eq. 4] across it. All in D.
///
///   H(q, p, x, v) = sum p_i^2 / 2 M_i(q) + m v^2 / 2 + gravity(q) + springs(q, x)
///
/// The mass matrix is diagonal: the axes cross at right angles, the barrel is round, and the two motors of the differential
/// turn as much for tilt as for yaw.
namespace presa::percro {

struct ArmState {
  Joints q = Joints::Zero();
  Vec3 p = Vec3::Zero();  ///< momenta M_i q_i'
  Vec3 x = Vec3::Zero();  ///< tip [m]
  Vec3 v = Vec3::Zero();  ///< [m/s]
};

/// Who holds the tip: m x'' = stiffness (target - x) + damping (target_velocity - x') + force + what the arm does.
struct TipLoad {
  double mass = 0.1;     ///< fingertip with thimble [kg]
  double stiffness = 0;  ///< [N/m]
  double damping = 0;    ///< [N s/m]
  Vec3 target = Vec3::Zero(), target_velocity = Vec3::Zero(), force = Vec3::Zero();
  bool held = false;  ///< bolted to the ground: x stays where it is
};

/// One step: implicit midpoint rule (second order, symplectic, stable at any step for what is linear), solved by Newton with
/// the springs' own stiffness; dry friction is solved with it exactly, so a joint that sticks does not creep. Thread: any;
/// nothing allocates.
class ArmDynamics {
 public:
  /// `gravity`: acceleration in D [m/s^2].
  ArmDynamics(const Parameters& parameters, const Vec3& gravity);

  /// h later under joint torques (motor torques through K^T).
  void step(ArmState& state, const Vec3& joint_torque, const TipLoad& load, double h) const noexcept;

  /// Diagonal of the mass matrix [kg m^2, kg m^2, kg].
  Vec3 inertia(const Joints& q) const noexcept;
  /// Joint torques that carry the arm's weight.
  Vec3 weight(const Joints& q) const noexcept;
  /// Of the arm on the tip [N].
  Vec3 tipForce(const ArmState& state) const noexcept;
  /// H and, of the load, its spring and its constant force.
  double energy(const ArmState& state, const TipLoad& load) const noexcept;
  /// Stiffness of the structure at a length, along and across the barrel [N/m].
  Vec3 stiffness(double length) const noexcept;
  /// At rest, the tip where the joints say.
  ArmState atRest(const Vec3& p_DT) const noexcept;

 private:
  struct Springs;
  Springs springs(const Joints& q, const Vec3& x, const Vec3& q_dot, const Vec3& v) const noexcept;
  double tiltInertia(const Joints& q, double across) const noexcept;
  double acrossInertia(double length) const noexcept;
  Vec3 centrifugal(const Joints& q, const Vec3& q_dot) const noexcept;

  Parameters parameters_;
  Vec3 gravity_;
};

}  // namespace presa::percro
