#pragma once
#include "devices/hand/motion.h"
#include "framework/core/math/spatial.h"

namespace presa {

/// A fingertip of mass m on the spring and damper of the hand:
///   m x'' = k (x_T - x) + b (v_T - x') + f,   f constant over a tick (zero-order hold).
/// Advanced by the exact discretisation of this linear system, so the simulated hand adds no energy of its own at any
/// rate. SI units, frame W. Thread: haptic; nonblocking.
class FingerPlant {
 public:
  FingerPlant(const FingerImpedance& impedance, double period);
  void reset(const Vec3& x, const Vec3& v = Vec3::Zero()) noexcept { x_ = x, v_ = v; }
  /// One tick towards the target position and velocity under the external force f [N].
  void step(const Vec3& p_WT, const Vec3& v_WT, const Vec3& f) noexcept;
  const Vec3& position() const noexcept { return x_; }
  const Vec3& velocity() const noexcept { return v_; }

 private:
  double stiffness_, damping_;
  double xx_, xv_, vx_, vv_;  // transition matrix over one period
  double xu_, vu_;            // response to a constant force of 1 N
  Vec3 x_ = Vec3::Zero(), v_ = Vec3::Zero();
};

/// Min damping [N s/m] for a stable fixed wall of this stiffness [N/m]: b >= K T / 2 without delay [Colgate1997].
double wallDampingBound(double contact_stiffness, double period) noexcept;

/// Min damping [N s/m] for which a held massless object settles. Such an object moves in a straight line to the
/// predicted position of the finger at the end of the dynamics step (position and velocity of the newest sample). The
/// prediction misses the finger's acceleration, and the contact spring turns that error into force. The bound comes
/// from the spectral radius of this loop over one dynamics step; objects with mass need less damping. Zero if none is
/// needed.
double heldObjectDampingBound(const FingerImpedance& impedance, double contact_stiffness, double period,
                              double dynamics_period);

/// The damping for "auto": both bounds with a margin, and at least 0.7 of the finger's critical damping.
double automaticDamping(const FingerImpedance& impedance, double contact_stiffness, double period,
                        double dynamics_period);

}  // namespace presa
