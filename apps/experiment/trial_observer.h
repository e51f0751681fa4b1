#pragma once
#include <algorithm>
#include <array>
#include <atomic>

#include "experiments/runner/definition/sample_names.h"
#include "experiments/runner/definition/trial.h"
#include "framework/core/schedule/executor.h"
#include "framework/device/output_stage.h"
#include "framework/record/haptic_observer.h"

namespace presa::experiment {

/// Last module of the haptic group: passes every tick to the trial's state machine, keeps quality figures, and asks the
/// run to stop when the trial has ended or a device is lost. Forces then fade, as at every stop. Thread: haptic;
/// nonblocking.
class TrialObserver final : public HapticObserver {
 public:
  TrialObserver(Trial& trial, const Experiment& experiment, const Scene& scene, RunControl& control)
      : HapticObserver("trial"),
        trial_(trial),
        control_(control),
        reader_(scene, experiment.askedSamples()),
        silent_(scene.devices.size()) {}

  void observe(const HapticSample& sample) noexcept override {
    if (trial_.state() != Trial::State::kRunning || lost_finger_ >= 0) return;
    reader_.read(sample.tick.time, sample.device, sample.contact, sample.command, sample.objects, trial_.samples());
    updateQuality(sample);
    const Trial::State state = trial_.step(sample.tick.time);
    phase_.store(trial_.phase(), std::memory_order_relaxed);
    if (state != Trial::State::kRunning || lost_finger_ >= 0)
      control_.stop_requested.store(true, std::memory_order_relaxed);
  }
  std::vector<std::string> stages() const override { return {"step the trial: guards, measures, quality"}; }

  double clippedSeconds() const noexcept { return clipped_; }
  double lostSeconds() const noexcept { return lost_; }
  /// Index of the first finger whose device was silent for longer than kLost; -1: none.
  int lostFinger() const noexcept { return lost_finger_; }
  static constexpr double kLost = 0.1;  ///< [s] well after the forces have faded; the trial is invalid then
  /// Index of the current phase. Thread: any.
  std::size_t phase() const noexcept { return phase_.load(std::memory_order_relaxed); }
  double maxForce() const noexcept { return max_force_; }
  double time() const noexcept { return time_; }

 private:
  void updateQuality(const HapticSample& sample) noexcept {
    const Tick& tick = sample.tick;
    time_ = tick.time;
    if ((sample.command.status & kOutputMagnitude) != 0) clipped_ += tick.period;
    bool lost = false;
    for (std::size_t f = 0; f < silent_.size(); ++f) {
      silent_[f] = sample.device.fingers[f].valid ? 0 : silent_[f] + tick.period;
      lost = lost || silent_[f] > 0;
      if (silent_[f] > kLost && lost_finger_ < 0) lost_finger_ = static_cast<int>(f);
      max_force_ = std::max(max_force_, sample.command.f_H_W[f].norm());
    }
    if (lost) lost_ += tick.period;
  }

  Trial& trial_;
  RunControl& control_;
  SampleReader reader_;
  std::vector<double> silent_;  // by finger [s] since the last sample
  int lost_finger_ = -1;
  std::atomic<std::size_t> phase_{0};
  double clipped_ = 0, lost_ = 0, max_force_ = 0, time_ = 0;
};

}  // namespace presa::experiment
