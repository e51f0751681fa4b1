#pragma once
#include "devices/hand/motion.h"
#include "framework/core/math/spatial.h"

namespace presa {

/// A fingertip of mass m on the spring and damper of the hand:
///   m x'' = k (x_T - x) + b (v_T - x') + f,   f constant over a tick (zero-order hold).
/// Advanced by the exact discretisation of this linear system, so the simulated hand adds no
/// energy of its own at any rate. Thread: haptic; nonblocking.
class FingerPlant {
 public:
  FingerPlant(const FingerImpedance& impedance, double period);
  void reset(const Vec3& x, const Vec3& v = Vec3::Zero()) noexcept { x_ = x, v_ = v; }
  /// One tick towards a target (position, velocity) under the force f.
  void step(const Vec3& p_WT, const Vec3& v_WT, const Vec3& f) noexcept;
  const Vec3& position() const noexcept { return x_; }
  const Vec3& velocity() const noexcept { return v_; }

 private:
  double stiffness_, damping_;
  double xx_, xv_, vx_, vv_;  // transition matrix over one period
  double xu_, vu_;            // response to a constant force of 1 N
  Vec3 x_ = Vec3::Zero(), v_ = Vec3::Zero();
};

/// Least damping with which a fixed wall of this stiffness is stable: K <= b / (T / 2) without delay [Colgate1997].
double wallDampingBound(double contact_stiffness, double period) noexcept;

/// Least damping with which a held object without mass of its own settles. Such an object goes where the finger was
/// predicted to be at the end of a dynamics step (position and velocity of the newest sample), in a straight line; the
/// prediction is wrong by the finger's acceleration, and the contact spring turns that into force. Found from the spectral
/// radius of this map over one dynamics step; objects with mass need less.
double heldObjectDampingBound(const FingerImpedance& impedance, double contact_stiffness, double period,
                              double dynamics_period);

/// "auto": both bounds with margin, and the finger itself at 0.7 of critical damping.
double automaticDamping(const FingerImpedance& impedance, double contact_stiffness, double period,
                        double dynamics_period);

}  // namespace presa
