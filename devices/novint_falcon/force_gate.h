#pragma once
#include <algorithm>

#include "framework/math/spatial.h"

namespace presa::falcon {

/// The last gate before the motors: soft start, slew, fade-out when what the force was made from is old.
/// Thread: the link's; nonblocking.
class ForceGate {
 public:
  /// `rate`: largest change of a force that goes on [N/s].
  explicit ForceGate(double rate) : rate_(rate) {}

  /// Zero at once; the next force starts softly.
  void cut() noexcept {
    out_.setZero();
    held_.setZero();
    gain_ = 0;
    fade_ = 0;
  }

  /// The force to send `elapsed` seconds after the last one. `fresh`: made from a position and by a haptic thread that are
  /// both alive; otherwise the last force fades out, faster than `rate` where it must.
  Vec3 step(const Vec3& wanted, bool fresh, double elapsed) noexcept {
    if (!wanted.allFinite()) {
      cut();
    } else if (!fresh) {
      gain_ = 0;
      fade_ = std::max(0.0, fade_ - elapsed / kFadeTime);
      out_ = fade_ > 1e-9 ? Vec3(fade_ * held_) : Vec3(Vec3::Zero());
    } else {
      gain_ = std::min(1.0, gain_ + elapsed / kSoftStart);
      const Vec3 way = gain_ * wanted - out_;
      const double length = way.norm(), reach = rate_ * elapsed;
      out_ += length > reach ? Vec3(way * (reach / length)) : way;
      held_ = out_;
      fade_ = 1;
    }
    return out_;
  }

  static constexpr double kSoftStart = 0.5;  ///< from nothing to all of the force [s]
  static constexpr double kFadeTime = 3e-3;  ///< to nothing [s]

 private:
  double rate_;
  double gain_ = 0, fade_ = 0;
  Vec3 out_ = Vec3::Zero(), held_ = Vec3::Zero();
};

}  // namespace presa::falcon
