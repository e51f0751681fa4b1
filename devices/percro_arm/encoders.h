#pragma once
#include <array>
#include <cmath>
#include <cstdint>

#include "devices/percro_arm/kinematics.h"

namespace presa::percro {

/// Position sensing of the arm: counts of three motor encoders, and their rates. A rate is the slope over the longest
/// past that a straight line fits within one count (first-order adaptive windowing [JanabiSharifi2000]): low noise when
/// slow, low delay when fast. Thread: haptic; nothing allocates.
class Encoders {
 public:
  explicit Encoders(const Parameters& parameters)
      : count_(parameters.motors.count()),
        whole_(parameters.motors.counted),
        to_motors_(transmission(parameters.geometry)),
        to_joints_(transmissionInverse(parameters.geometry)) {}

  /// Power-up: the counters start at arbitrary values, and their zero is unknown until setZero().
  void powerUp(const Vec3& counts_at_zero) noexcept { true_zero_ = counts_at_zero; }
  /// Sets the counts that correspond to q = 0, not necessarily whole (homing.h).
  void setZero(const Vec3& counts) noexcept { zero_ = counts; }

  /// Restarts at rest at q.
  void reset(const Joints& q) noexcept {
    used_ = 0;
    sample(q);
  }
  /// Samples the joints; call once per period.
  void sample(const Joints& q) noexcept {
    newest_ = (newest_ + 1) % kWindow;
    const Vec3 motors = to_motors_ * q / count_;
    for (int i = 0; i < 3; ++i) past_[newest_][i] = (whole_ ? std::nearbyint(motors[i]) : motors[i]) + true_zero_[i];
    used_ = std::min(used_ + 1, kWindow);
  }
  Joints joints() const noexcept { return to_joints_ * (count_ * (past_[newest_] - zero_)); }
  Vec3 jointRates(double period) const noexcept {
    if (!whole_)
      return to_joints_ * (count_ / period * (past_[newest_] - past_[(newest_ + kWindow - (used_ > 1)) % kWindow]));
    return to_joints_ * (count_ / period * Vec3(slope(0), slope(1), slope(2)));
  }

 private:
  static constexpr int kWindow = 16;
  double at(int motor, int ago) const noexcept { return past_[(newest_ + kWindow - ago) % kWindow][motor]; }
  double slope(int motor) const noexcept {
    double best = 0;
    for (int n = 1; n < used_; ++n) {
      const double candidate = (at(motor, 0) - at(motor, n)) / n;
      for (int i = 1; i < n; ++i) {
        if (std::abs(at(motor, 0) - candidate * i - at(motor, i)) > 1) return best;
      }
      best = candidate;
    }
    return best;
  }

  double count_;
  bool whole_;
  Mat3 to_motors_, to_joints_;
  Vec3 true_zero_ = Vec3::Zero(), zero_ = Vec3::Zero();
  std::array<Vec3, kWindow> past_{};
  int newest_ = 0, used_ = 0;
};

}  // namespace presa::percro
