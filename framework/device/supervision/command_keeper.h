#pragma once
#include <algorithm>

#include "framework/core/state/device_state.h"
#include "framework/device/output_stage.h"

namespace presa {

/// Decides which force reaches a device whose program may stop or die at any moment. While commands come, it passes
/// them through an output stage of its own; when they stop, it takes the force to zero at the slew limit. After that,
/// only a command of exactly zero lets forces pass again, so that a returning program starts at zero.
/// Thread: one; nonblocking.
class CommandKeeper {
 public:
  /// Enforces the driver's rating, so that wrong limits in the program or its files have no effect here.
  explicit CommandKeeper(const DeviceRating& rating) : stage_(limitsOf(rating)) {}

  /// What came since the last step.
  struct Input {
    bool fresh = false;    ///< a command came since the last step
    bool alone = false;    ///< the program is gone; latches
    Wrench command = {};   ///< the newest one, on the tool in W
    FingerInput finger{};  ///< sample of the device now
  };

  /// Returns the wrench to send, in W. `elapsed`: since the last step, by the clock [s]. A delayed keeper still
  /// drops an old command in time; its force then goes down by at most kLongestStep of slew.
  const Wrench& step(const Input& input, double elapsed) noexcept {
    age_ = input.fresh ? 0 : age_ + elapsed;
    alone_ = alone_ || input.alone;
    if (alone_ || age_ > kHold)
      dropped_ = true;
    else if (input.fresh && input.command == Wrench())
      dropped_ = false;
    return stage_.step({.command = input.command,
                        .trust = dropped_ ? OutputStage::Trust::kDropped : OutputStage::Trust::kGood,
                        .lost = input.finger.lost,
                        .p_WH = input.finger.p_WH,
                        .v_WH = input.finger.v_WH,
                        .w_WT = input.finger.w_WT,
                        .q_WT = input.finger.q_WT},
                       std::min(elapsed, kLongestStep));
  }

  void rearm() noexcept { stage_.rearm(); }                      ///< clears latched faults of its output stage
  bool dropped() const noexcept { return dropped_; }             ///< no force until a command of exactly zero
  const Wrench& last() const noexcept { return stage_.last(); }  ///< wrench of the last step, in W

  /// Longest age of a command [s]: more than a late haptic tick, short enough for zero within 10 ms from 5 N.
  static constexpr double kHold = 5e-3;
  static constexpr double kLongestStep = 1e-3;  ///< [s]

 private:
  OutputStage stage_;
  double age_ = 0;
  bool dropped_ = true, alone_ = false;
};

}  // namespace presa
