#pragma once
#include "framework/device/output_stage.h"
#include "framework/state/device_state.h"

namespace presa {

/// Which force reaches a device whose program may stop or die at any moment: the commanded one, through an output stage of its own,
/// while commands come; zero, as fast as the slew limit allows, as soon as they do not. Then only a command of exactly zero opens the
/// way again: whoever comes back begins at zero.
/// Thread: one; nonblocking.
class CommandKeeper {
 public:
  /// The energy to the hand is counted by the program's stage; twice would take it twice.
  explicit CommandKeeper(OutputLimits limits) : stage_((limits.passivity = false, limits)) {}

  struct Input {
    bool fresh = false;  ///< a command came since the last step
    bool alone = false;  ///< the program is gone
    Vec3 command = Vec3::Zero();
    FingerInput finger{};
  };

  Vec3 step(const Input& input, double period) noexcept {
    age_ = input.fresh ? 0 : age_ + period;
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
                       period);
  }

  void rearm() noexcept { stage_.rearm(); }
  bool dropped() const noexcept { return dropped_; }
  const Vec3& last() const noexcept { return stage_.last(); }

  /// Of a command [s]: longer than a late haptic tick, short enough for zero within 10 ms from 5 N.
  static constexpr double kHold = 5e-3;

 private:
  OutputStage stage_;
  double age_ = 0;
  bool dropped_ = true, alone_ = false;
};

}  // namespace presa
