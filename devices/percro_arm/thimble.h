#pragma once
#include <cmath>
#include <numbers>

#include "devices/percro_arm/kinematics.h"

namespace presa::percro {

/// The thimble on the passive wrist, with an encoder on each of its three axes: the finger turns it, no motor does. The
/// modelled finger keeps the orientation that it had when the arm was placed. All in D. Thread: haptic; nothing allocates.
class Thimble {
 public:
  /// A finger in line with the barrel.
  void place(const Joints& q) noexcept {
    finger_ = barrelFrame(q);
    orientation_ = Quat(finger_);
    rate_.setZero();
  }
  /// One period: measures the wrist of an arm at `q` whose own encoders report `reported`.
  void sample(const Joints& q, const Joints& reported, double period) noexcept {
    Vec3 wrist = wristAt(q, finger_);
    for (double& angle : wrist) angle = kCount * std::nearbyint(angle / kCount);
    const Quat now(thimbleFrame(reported, wrist));
    Quat turn = now * orientation_.conjugate();
    if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
    const Eigen::AngleAxisd step(turn);
    rate_ += period / (kSmoothing + period) * (step.angle() / period * step.axis() - rate_);
    orientation_ = now;
  }
  const Quat& orientation() const noexcept { return orientation_; }
  const Vec3& rate() const noexcept { return rate_; }  ///< [rad/s]

  static constexpr double kCount = 2 * std::numbers::pi / 4096;  ///< GUESS: the paper gives no resolution [rad]
  static constexpr double kSmoothing = 0.01;                     ///< time constant of the rate [s]

 private:
  Mat3 finger_ = Mat3::Identity();
  Quat orientation_ = Quat::Identity();
  Vec3 rate_ = Vec3::Zero();
};

}  // namespace presa::percro
