#pragma once
#include <functional>

#include "framework/core/graph/module.h"
#include "framework/core/schedule/executor.h"
#include "framework/session/view.h"

namespace presa {

/// Keeps a lockstep run with a window at the pace that its user asks for: the last module of the view group, whose steps wait. A single
/// step is one picture. Not for hardware, which must not be held. Meanwhile
/// commands are read: there is one thread, and the bus does not step.
class Pacer final : public Module {
 public:
  /// `view` is set before the first step; null: nobody looks on. All outlive this.
  Pacer(const TimeWish& wish, View*& view, const RunControl& control, const std::function<void(double)>& meanwhile)
      : Module("pace", RateGroup::kView), wish_(wish), view_(view), control_(control), meanwhile_(meanwhile) {}
  void step(const Tick& tick) noexcept override;
  std::vector<std::string> stages() const override { return {"wait as long as the user wants"}; }

 private:
  bool due(double time) noexcept;

  const TimeWish& wish_;
  View*& view_;
  const RunControl& control_;
  const std::function<void(double)>& meanwhile_;  // with the simulated time
  std::uint32_t steps_ = 0;                       // done
  double speed_ = 0;                              // since the anchor; 0: there is none
  double anchor_time_ = 0;
  std::int64_t anchor_ns_ = 0;
};

}  // namespace presa
