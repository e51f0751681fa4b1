#pragma once
#include <algorithm>

#include "framework/core/state/device_state.h"
#include "framework/device/output_stage.h"

namespace presa {

/// Which force reaches a device whose program may stop or die at any moment: the commanded one, through an output stage of its own,
/// while commands come; zero, as fast as the slew limit allows, as soon as they do not. Then only a command of exactly zero opens the
/// way again: whoever comes back begins at zero.
/// Thread: one; nonblocking.
class CommandKeeper {
 public:
  /// Keeps to the rating alone: a program that lies, or has been lied to, is held by it, too.
  explicit CommandKeeper(const DeviceRating& rating) : stage_(limitsOf(rating)) {}

  struct Input {
    bool fresh = false;  ///< a command came since the last step
    bool alone = false;  ///< the program is gone
    Vec3 command = Vec3::Zero();
    FingerInput finger{};
  };

  /// `elapsed`: since the step before, by the clock [s]. Who was held up himself drops a command that is old no later, and goes down by
  /// what the time allowed, though never by more than a haptic tick may.
  Vec3 step(const Input& input, double elapsed) noexcept {
    age_ = input.fresh ? 0 : age_ + elapsed;
    alone_ = alone_ || input.alone;
    if (alone_ || age_ > kHold)
      dropped_ = true;
    else if (input.fresh && input.command == Vec3::Zero())
      dropped_ = false;
    return stage_.step({.command = input.command,
                        .trust = dropped_ ? OutputStage::Trust::kDropped : OutputStage::Trust::kGood,
                        .lost = input.finger.lost,
                        .p_WH = input.finger.p_WH,
                        .v_WH = input.finger.v_WH},
                       std::min(elapsed, kLongestStep));
  }

  void rearm() noexcept { stage_.rearm(); }
  bool dropped() const noexcept { return dropped_; }
  const Vec3& last() const noexcept { return stage_.last(); }

  /// Of a command [s]: longer than a late haptic tick, short enough for zero within 10 ms from 5 N.
  static constexpr double kHold = 5e-3;
  static constexpr double kLongestStep = 1e-3;  ///< [s]

 private:
  OutputStage stage_;
  double age_ = 0;
  bool dropped_ = true, alone_ = false;
};

}  // namespace presa
