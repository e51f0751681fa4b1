#pragma once
#include <algorithm>

#include "framework/core/math/spatial.h"
#include "framework/device/device_rating.h"

namespace presa::falcon {

/// The last stage before the motors: limits magnitude and slew rate, starts softly, and ramps to zero when its inputs
/// cannot be trusted. Even a fault never causes a step above the slew limit, because a hand that leans on a suddenly
/// vanishing force would jump. Thread: the link's; nonblocking.
class ForceGate {
 public:
  explicit ForceGate(const DeviceRating& rating) : max_force_(rating.force), rate_(rating.force_rate) {}

  /// Sets the force to zero at once: at the start, and where no force can be computed any more.
  void cut() noexcept {
    out_.setZero();
    gain_ = 0;
  }
  /// Makes the next force start softly.
  void soften() noexcept { gain_ = 0; }
  bool quiet() const noexcept { return out_.isZero(0); }

  /// The force to send `elapsed` seconds after the last one [N]. `fresh`: position and command are recent; otherwise,
  /// or when the force is not finite, it ramps to zero. After a short gap it returns at the slew limit, since late
  /// replies are common; after a longer one it starts softly.
  Vec3 step(const Vec3& wanted, bool fresh, double elapsed) noexcept {
    if (fresh && wanted.allFinite()) {
      gap_ = 0;
      gain_ = std::min(1.0, gain_ + elapsed / kSoftStart);
      go(gain_ * bounded(wanted), elapsed);
    } else {
      gap_ += elapsed;
      if (gap_ > kShortGap || fresh) gain_ = 0;
      go(Vec3::Zero(), elapsed);
    }
    return out_;
  }

  static constexpr double kSoftStart = 0.5;    ///< duration of the ramp from zero to full force [s]
  static constexpr double kShortGap = 3.5e-3;  ///< [s]

 private:
  /// Scales by the largest component first: the square of 1e308 would overflow.
  Vec3 bounded(Vec3 force) const noexcept {
    if (const double largest = force.cwiseAbs().maxCoeff(); largest > max_force_) force *= max_force_ / largest;
    if (const double norm = force.norm(); norm > max_force_) force *= max_force_ / norm;
    return force;
  }
  void go(const Vec3& where, double elapsed) noexcept {
    const Vec3 way = where - out_;
    const double length = way.norm(), reach = rate_ * elapsed;
    if (length > reach) {
      out_ += way * (reach / length);
    } else {
      out_ = where;
    }
  }

  double max_force_, rate_;  // [N], [N/s]
  double gain_ = 0, gap_ = 0;
  Vec3 out_ = Vec3::Zero();
};

}  // namespace presa::falcon
