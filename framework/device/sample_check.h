#pragma once
#include <algorithm>
#include <cmath>

#include "framework/core/state/device_state.h"

namespace presa {

/// Checks the samples of one device. A sample that is not finite, or farther from the last good one than a hand can
/// move, is rejected; the second rejection in a row latches. A missing, rejected or old sample is bridged for kHold by
/// the last good position with zero velocity; after that the finger is not valid. Thread: haptic; nonblocking.
class SampleCheck {
 public:
  static constexpr double kFastest = 20;        ///< speed that no hand reaches [m/s]
  static constexpr double kFastestTurn = 200;   ///< angular speed that no hand reaches [rad/s]
  static constexpr double kHold = 1e-3 + 1e-9;  ///< longest age of a sample that is used or bridged [s]

  /// Takes the device's sample, returns the checked one. `period`: since the last call [s]. `lost` stays set until
  /// rearm().
  FingerInput take(FingerInput input, double period) noexcept {
    since_ += period;
    const bool rejected = input.valid && !possible(input);
    latched_ = latched_ || input.lost || (rejected && suspect_);
    suspect_ = rejected;
    input.lost = latched_;
    if (input.valid && !rejected && input.age <= kHold) {
      since_ = input.age;
      good_ = input;
    } else {
      input.p_WH = good_.p_WH;
      input.v_WH.setZero();
      input.oriented = good_.oriented;
      input.q_WT = good_.q_WT;
      input.w_WT.setZero();
      input.valid = good_.valid && since_ <= kHold && input.age <= kHold;
    }
    input.valid = input.valid && !latched_;
    return input;
  }
  bool latched() const noexcept { return latched_; }  ///< samples are rejected until rearm()
  /// Clears the latch and accepts the next finite position, wherever it is.
  void rearm() noexcept {
    latched_ = suspect_ = false;
    good_.valid = false;
  }

 private:
  bool possible(const FingerInput& input) const noexcept {
    if (!input.p_WH.allFinite() || !input.v_WH.allFinite() || !(input.age >= 0)) return false;
    if (input.oriented && !possibleTurn(input)) return false;
    return !good_.valid || (input.p_WH - good_.p_WH).norm() <= kFastest * since_;
  }
  bool possibleTurn(const FingerInput& input) const noexcept {
    constexpr double kRounding = 1e-6;  // of a unit quaternion
    if (!(std::abs(input.q_WT.norm() - 1) <= kRounding) || !input.w_WT.allFinite()) return false;
    const bool known = good_.valid && good_.oriented;
    return !known || input.q_WT.angularDistance(good_.q_WT) <= kFastestTurn * since_ + kRounding;
  }
  FingerInput good_;
  double since_ = 0;  // age of the last good sample [s]
  bool suspect_ = false, latched_ = false;
};

}  // namespace presa
