#pragma once
#include <algorithm>

#include "framework/core/state/device_state.h"

namespace presa {

/// What a device says of a finger, before anybody believes it. Not finite, or further from the last good sample than a hand gets: such
/// a sample is rejected, the second in a row latches. A sample that is missing, rejected or old is bridged by the one before, at
/// rest, for kHold; after that the finger is not valid. Thread: haptic; nonblocking.
class SampleCheck {
 public:
  static constexpr double kFastest = 20;        ///< faster than a hand throws [m/s]
  static constexpr double kHold = 1e-3 + 1e-9;  ///< since the sample was due [s]

  /// What the rest of the graph is to work with; `lost`: until a re-arm.
  FingerInput take(FingerInput input, double period) noexcept {
    since_ += period;
    const bool rejected = input.valid && !possible(input);
    latched_ = latched_ || input.lost || (rejected && doubted_);
    doubted_ = rejected;
    input.lost = latched_;
    if (input.valid && !rejected && input.age <= kHold) {
      since_ = input.age;
      good_ = input;
    } else {
      input.p_WH = good_.p_WH;
      input.v_WH.setZero();
      input.valid = good_.valid && since_ <= kHold && input.age <= kHold;
    }
    input.valid = input.valid && !latched_;
    return input;
  }
  bool latched() const noexcept { return latched_; }
  /// The place is believed anew.
  void rearm() noexcept {
    latched_ = doubted_ = false;
    good_.valid = false;
  }

 private:
  bool possible(const FingerInput& input) const noexcept {
    if (!input.p_WH.allFinite() || !input.v_WH.allFinite() || !(input.age >= 0)) return false;
    return !good_.valid || (input.p_WH - good_.p_WH).norm() <= kFastest * since_;
  }
  FingerInput good_;
  double since_ = 0;  // the last good one [s]
  bool doubted_ = false, latched_ = false;
};

}  // namespace presa
