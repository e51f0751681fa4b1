#pragma once
#include "devices/percro_arm/kinematics.h"

/// Dynamics of the arm and the load at its tip. The encoders measure the joints; the structure ties the tip to them by
/// springs in the barrel frame: stiff along the barrel, [Bergamasco2006 eq. 4] across it. All in frame D.
///
///   H(q, p, x, v) = sum p_i^2 / 2 M_i(q) + m v^2 / 2 + gravity(q) + springs(q, x)
///
/// The mass matrix is diagonal: the axes intersect at right angles, the barrel is axisymmetric, and the two motors of
/// the differential rotate equally for tilt and yaw.
namespace presa::percro {

struct ArmState {
  Joints q = Joints::Zero();
  Vec3 p = Vec3::Zero();  ///< momenta M_i q_i'
  Vec3 x = Vec3::Zero();  ///< tip [m]
  Vec3 v = Vec3::Zero();  ///< [m/s]
};

/// Load at the tip: m x'' = stiffness (target - x) + damping (target_velocity - x') + force + force of the arm.
struct TipLoad {
  double mass = 0.1;     ///< fingertip with thimble [kg]
  double stiffness = 0;  ///< [N/m]
  double damping = 0;    ///< [N s/m]
  Vec3 target = Vec3::Zero(), target_velocity = Vec3::Zero(), force = Vec3::Zero();
  bool held = false;  ///< bolted to the ground: x is constant
};

/// One step by the implicit midpoint rule (second order, symplectic, unconditionally stable for linear systems), solved
/// by Newton's method. Dry friction is solved exactly with it, so a sticking joint does not creep. Thread: any; nothing
/// allocates.
class ArmDynamics {
 public:
  /// `gravity`: acceleration in D [m/s^2].
  ArmDynamics(const Parameters& parameters, const Vec3& gravity);

  /// Advances by h [s] under joint torques (motor torques through K^T).
  void step(ArmState& state, const Vec3& joint_torque, const TipLoad& load, double h) const noexcept;

  /// Diagonal of the mass matrix [kg m^2, kg m^2, kg].
  Vec3 inertia(const Joints& q) const noexcept;
  /// Joint torques that compensate the arm's weight.
  Vec3 weight(const Joints& q) const noexcept;
  /// Force of the arm on the tip [N].
  Vec3 tipForce(const ArmState& state) const noexcept;
  /// H, plus the energy of the load's spring and constant force [J].
  double energy(const ArmState& state, const TipLoad& load) const noexcept;
  /// Stiffness of the structure at a barrel length [m], along and across the barrel [N/m].
  Vec3 stiffness(double length) const noexcept;
  /// State at rest with the tip at p_DT and an unloaded structure.
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
