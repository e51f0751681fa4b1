#pragma once
#include <algorithm>

#include "framework/device/device_rating.h"
#include "framework/core/math/spatial.h"

namespace presa::falcon {

/// The last gate before the motors: magnitude, soft start, slew, and down to zero when what the force was made from is not to be trusted. Nothing
/// makes a step that the rating does not allow, not even a fault: a hand that leans on a force which is gone at once would jump.
/// Thread: the link's; nonblocking.
class ForceGate {
 public:
  explicit ForceGate(const DeviceRating& rating) : most_(rating.force), rate_(rating.force_rate) {}

  /// Nothing is in the motors: for the start, and where no force can be worked out any more.
  void cut() noexcept {
    out_.setZero();
    gain_ = 0;
  }
  /// What comes next starts softly.
  void soften() noexcept { gain_ = 0; }
  bool quiet() const noexcept { return out_.isZero(0); }

  /// The force to send `elapsed` seconds after the last one. `fresh`: made from a position and by a haptic thread that are
  /// both alive; otherwise, or when it is not finite, the force goes to zero. After a short gap it comes back at the slew limit, for
  /// a reply that is late is nothing unusual; after a longer one softly.
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

  static constexpr double kSoftStart = 0.5;    ///< from nothing to all of the force [s]
  static constexpr double kShortGap = 3.5e-3;  ///< [s]

 private:
  /// By the largest component first: the square of 1e308 would overflow.
  Vec3 bounded(Vec3 force) const noexcept {
    if (const double largest = force.cwiseAbs().maxCoeff(); largest > most_) force *= most_ / largest;
    if (const double norm = force.norm(); norm > most_) force *= most_ / norm;
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

  double most_, rate_;  // [N], [N/s]
  double gain_ = 0, gap_ = 0;
  Vec3 out_ = Vec3::Zero();
};

}  // namespace presa::falcon
