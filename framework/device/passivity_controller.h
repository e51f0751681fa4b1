#pragma once
#include <algorithm>

#include "framework/core/math/spatial.h"

namespace presa {

/// Time-domain passivity control at the device port [HannafordRyu2002], of a force and a position; or of a torque [N m]
/// and the rotation so far as a vector [rad]: counts the energy that the finger received and
/// adds damping as soon as this exceeds the energy that it gave. The count is exact under zero-order hold:
/// E(k) = sum f(k-1) (x(k) - x(k-1)) with f the force that was sent; the usual sum of f(k) v(k) has the wrong sign on a
/// sampled wall. Used only if the rig sets `passivity`.
/// Thread: haptic; nonblocking.
class PassivityController {
 public:
  /// `max_damping`: a stronger damper would make the device's inertia oscillate within a period [N s/m].
  explicit PassivityController(double max_damping = kMaxDamping) : max_damping_(max_damping) {}

  /// The force to send instead of `wanted` [N]; x: position [m], v: velocity [m/s] of the finger now; period [s].
  Vec3 step(const Vec3& wanted, const Vec3& x, const Vec3& v, double period) noexcept {
    if (started_) given_ += sent_.dot(x - x_);
    x_ = x;
    started_ = true;
    const double speed2 = v.squaredNorm();
    // damps in advance the energy that `wanted` will give until the next sample
    const double excess = given_ + wanted.dot(v) * period;
    damping_ = excess > 0 && speed2 > 0 ? std::min(excess / (speed2 * period), max_damping_) : 0;
    return wanted - damping_ * v;
  }
  /// The force that the later stages really sent [N]; call after every step().
  void sent(const Vec3& force) noexcept { sent_ = force; }

  double given() const noexcept { return given_; }       ///< net energy to the finger so far [J]
  bool acting() const noexcept { return damping_ > 0; }  ///< the last step added damping

  static constexpr double kMaxDamping = 20;        ///< of a fingertip [N s/m]
  static constexpr double kMaxTurnDamping = 0.05;  ///< of a tool that turns [N m s/rad]: 20 N s/m at an arm of 5 cm

 private:
  double max_damping_;
  Vec3 x_ = Vec3::Zero(), sent_ = Vec3::Zero();
  double given_ = 0, damping_ = 0;
  bool started_ = false;
};

}  // namespace presa
