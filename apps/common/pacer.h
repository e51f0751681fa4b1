#pragma once
#include <functional>

#include "framework/core/graph/module.h"
#include "framework/core/schedule/clock.h"
#include "framework/core/schedule/executor.h"
#include "framework/session/view.h"

namespace presa {

/// Where the pacer's wall time comes from [ns]; tests have one of their own.
struct WallClock {
  std::int64_t (*now)() noexcept = monotonicNs;
  void (*sleep_until)(std::int64_t) noexcept = sleepUntilNs;
};

/// Paces a lockstep run at the speed that the user of the window asks for: the last module of the view group; its step
/// waits. A single step is one picture. Not for hardware, which must not be paused. While it waits it calls
/// `meanwhile`, which reads commands: there is only one thread, and the bus group does not step.
///
/// A run that is late by more than a frame leaves pictures out (TimeControl::skip_picture), but draws 4 a second: slow
/// drawing does not slow the run, as long as the rest of its work is faster than the clock.
class Pacer final : public Module {
 public:
  /// `view` is set before the first step; null: no window. All arguments must outlive this.
  Pacer(TimeControl& time_control, View*& view, const RunControl& control, const std::function<void(double)>& meanwhile,
        WallClock clock = {})
      : Module("pace", RateGroup::kView),
        time_control_(time_control),
        view_(view),
        control_(control),
        meanwhile_(meanwhile),
        clock_(clock) {}
  void step(const Tick& tick) noexcept override;
  std::vector<std::string> stages() const override {
    return {"wait until the clock reaches the simulated time, or leave pictures out; pause and speed as requested"};
  }

 private:
  bool due(double time) noexcept;
  void choosePicture() noexcept;

  TimeControl& time_control_;
  View*& view_;
  const RunControl& control_;
  const std::function<void(double)>& meanwhile_;  // called with the simulated time
  const WallClock clock_;
  std::uint32_t steps_ = 0;  // single steps done
  double speed_ = 0;         // speed since the anchor; 0: no anchor
  double anchor_time_ = 0;
  std::int64_t anchor_ns_ = 0;
  std::int64_t late_ns_ = 0;     // of the last step
  std::int64_t picture_ns_ = 0;  // when the last picture was due
};

}  // namespace presa
