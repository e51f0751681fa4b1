#pragma once
#include "devices/hand/finger_plant.h"

namespace presa {

/// A tool that a hand holds in a wanted orientation with a rotational spring and damper, and that yields to torques:
/// r'' = (t - k r - b r') / I for the rotation vector r from the wanted to the real orientation, exact for a torque held
/// over a tick. Small angles; the acceleration of the wanted orientation is left out. Thread: haptic; nonblocking.
class TurnPlant {
 public:
  /// `inertia` [kg m^2], `stiffness` [N m/rad], `damping` [N m s/rad]: a stylus of 50 g and 15 cm in three fingers.
  struct Impedance {
    double inertia = 1e-4, stiffness = 0.3, damping = 0.01;
  };
  TurnPlant(const Impedance& impedance, double period)
      : plant_({.mass = impedance.inertia, .stiffness = impedance.stiffness, .damping = impedance.damping}, period) {}

  /// One tick under the torque t [N m], in W.
  void step(const Vec3& t) noexcept { plant_.step(Vec3::Zero(), Vec3::Zero(), t); }
  /// The real orientation, for the wanted one.
  Quat orientation(const Quat& q_WT) const noexcept { return turnBy(plant_.position()) * q_WT; }
  /// The real angular velocity, for the wanted one [rad/s].
  Vec3 rate(const Vec3& w_WT) const noexcept { return w_WT + plant_.velocity(); }

  /// Rotation about the direction of r by |r|.
  static Quat turnBy(const Vec3& r) noexcept {
    const double angle = r.norm();
    return angle > 0 ? Quat(Eigen::AngleAxisd(angle, r / angle)) : Quat(Quat::Identity());
  }

 private:
  FingerPlant plant_;
};

}  // namespace presa
