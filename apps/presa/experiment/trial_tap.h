#pragma once
#include <algorithm>
#include <array>

#include "framework/device/output_stage.h"
#include "framework/experiment/sample_names.h"
#include "framework/experiment/trial.h"
#include "framework/graph/port.h"
#include "framework/schedule/executor.h"

namespace presa::experiment {

/// Last of the haptic group: shows every tick to the trial, keeps the figures of its quality, and asks the run to stop when the
/// trial has ended. Forces fade then, as at every stop. Thread: haptic; nonblocking.
class TrialTap final : public Module {
 public:
  TrialTap(Trial& trial, const Experiment& experiment, const Scene& scene, RunControl& control)
      : Module("trial", RateGroup::kHaptic),
        trial_(trial),
        control_(control),
        reader_(scene, experiment.askedSamples()),
        fingers_(scene.devices.size()) {}

  void step(const Tick& tick) noexcept override {
    if (trial_.state() != Trial::State::kRunning) return;
    reader_.read(tick.time, device_.value(), contact_.value(), command_.value(),
                 objects_.hasValue() ? &objects_.value() : nullptr, trial_.samples());
    judge(tick);
    if (trial_.step(tick.time) != Trial::State::kRunning)
      control_.stop_requested.store(true, std::memory_order_relaxed);
  }
  std::vector<std::string> stages() const override { return {"step the trial: guards, measures, quality"}; }

  double clippedSeconds() const noexcept { return clipped_; }
  double lostSeconds() const noexcept { return lost_; }
  double mostForce() const noexcept { return most_; }
  double time() const noexcept { return time_; }

 private:
  void judge(const Tick& tick) noexcept {
    time_ = tick.time;
    if ((command_->status & kOutputMagnitude) != 0) clipped_ += tick.period;
    bool lost = false;
    for (std::size_t f = 0; f < fingers_; ++f) {
      lost = lost || !device_->fingers[f].valid;
      most_ = std::max(most_, command_->f_H_W[f].norm());
    }
    if (lost) lost_ += tick.period;
  }

  Trial& trial_;
  RunControl& control_;
  SampleReader reader_;
  std::size_t fingers_;
  double clipped_ = 0, lost_ = 0, most_ = 0, time_ = 0;
  In<DeviceState> device_{*this, "device_state"};
  In<ContactExchange> contact_{*this, "contact_exchange"};
  In<ForceCommand> command_{*this, "force_command"};
  In<ObjectState> objects_{*this, "object_state", In<ObjectState>::Optional{}};
};

}  // namespace presa::experiment
