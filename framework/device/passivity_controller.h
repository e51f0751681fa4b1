#pragma once
#include <algorithm>

#include "framework/core/math/spatial.h"

namespace presa {

/// Time-domain passivity at the device port [HannafordRyu2002]: what the finger got is counted, and taken back by damping as soon as it
/// is more than it gave. The count is exact under zero-order hold: E(k) = sum f(k-1) (x(k) - x(k-1)), f the force that was really
/// sent; the usual sum of f(k) v(k) has the wrong sign on a sampled wall. In the graph only where the rig names it.
/// Thread: haptic; nonblocking.
class PassivityController {
 public:
  /// The force to send instead of `wanted` [N]; x: position [m], v: velocity [m/s] of the finger now.
  Vec3 step(const Vec3& wanted, const Vec3& x, const Vec3& v, double period) noexcept {
    if (started_) given_ += sent_.dot(x - x_);
    x_ = x;
    started_ = true;
    const double speed2 = v.squaredNorm();
    // what `wanted` will give until the next sample is taken back beforehand
    const double excess = given_ + wanted.dot(v) * period;
    damping_ = excess > 0 && speed2 > 0 ? std::min(excess / (speed2 * period), kMostDamping) : 0;
    return wanted - damping_ * v;
  }
  /// What became of it behind this stage [N].
  void sent(const Vec3& force) noexcept { sent_ = force; }

  double given() const noexcept { return given_; }  ///< net energy to the finger so far [J]
  bool acting() const noexcept { return damping_ > 0; }

  /// A damper stronger than the device's own inertia can follow within a period would shake [N s/m].
  static constexpr double kMostDamping = 20;

 private:
  Vec3 x_ = Vec3::Zero(), sent_ = Vec3::Zero();
  double given_ = 0, damping_ = 0;
  bool started_ = false;
};

}  // namespace presa
