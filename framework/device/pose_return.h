#pragma once
#include <limits>

#include "framework/device/frame_motion.h"
#include "framework/device/minimum_jerk.h"

namespace presa {

/// The way back to a measured pose without a jump: what is shown differs from it by an offset that fades along a
/// minimum-jerk path, so that no step is longer than the measured one and that of a movement with a peak speed of
/// 1.875 offset / kTime. Thread: any one; nonblocking.
class PoseReturn {
 public:
  static constexpr double kTime = 0.8;  ///< [s]

  /// Starts at `time` [s] from the pose shown, towards `measured`.
  void begin(const Pose& shown, const Pose& measured, double time) noexcept {
    d_ = shown.p - measured.p;
    turn_ = Eigen::AngleAxisd(shortest(shown.q * measured.q.conjugate()));
    begin_ = time;
  }
  bool over(double time) const noexcept { return time - begin_ >= kTime; }  ///< from then on the measured pose is shown
  /// What is shown at `time`, with its velocities; `measured` itself once it is over.
  FrameMotion at(const FrameMotion& measured, double time) const noexcept {
    if (over(time)) return measured;
    const double s = (time - begin_) / kTime, left = 1 - minimumJerk(s), rate = -minimumJerkSlope(s) / kTime;
    const Quat turned(Eigen::AngleAxisd(left * turn_.angle(), turn_.axis()));
    FrameMotion shown = measured;
    shown.X_WF = {measured.X_WF.p + left * d_, (turned * measured.X_WF.q).normalized()};
    shown.v_WF += rate * d_;
    shown.w_WF = rate * turn_.angle() * turn_.axis() + turned * measured.w_WF;
    return shown;
  }

 private:
  static Quat shortest(const Quat& q) noexcept { return q.w() < 0 ? Quat(-q.coeffs()) : q; }

  Vec3 d_ = Vec3::Zero();
  Eigen::AngleAxisd turn_{Quat::Identity()};
  double begin_ = -std::numeric_limits<double>::infinity();  // [s]
};

}  // namespace presa
