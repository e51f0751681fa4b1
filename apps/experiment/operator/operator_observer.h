#pragma once
#include <atomic>
#include <string>
#include <utility>
#include <vector>

#include "experiments/runner/definition/trial.h"
#include "framework/device/output_stage.h"
#include "framework/record/haptic_observer.h"

namespace presa::experiment {

/// Live values of the running trial for the operator. Written by the haptic thread, read by the main thread. Each value
/// is atomic; the set may mix two ticks.
struct TrialLive {
  /// Before the run.
  void setRoles(std::vector<std::string> of_fingers) {
    roles = std::move(of_fingers);
    force = std::vector<std::atomic<double>>(roles.size());
    mode = std::vector<std::atomic<std::int32_t>>(roles.size());
  }

  std::vector<std::string> roles;                                     ///< of the fingers
  std::atomic<double> time{0}, phase_begin{0}, watch{0}, clipped{0};  // [s], except `watch`
  std::atomic<std::size_t> phase{0};
  std::atomic<bool> device_lost{false};
  std::vector<std::atomic<double>> force;       // normal, by finger [N]
  std::vector<std::atomic<std::int32_t>> mode;  // by finger
};

/// Writes TrialLive every tick. In the graph only when there is a display. Thread: haptic; nonblocking.
class OperatorObserver final : public HapticObserver {
 public:
  OperatorObserver(const Trial& trial, const Experiment& experiment, TrialLive& live)
      : HapticObserver("operator"), trial_(trial), experiment_(experiment), live_(live) {}

  void observe(const HapticSample& sample) noexcept override {
    const auto& [tick, device, contact, command, objects, version] = sample;
    constexpr auto kRelaxed = std::memory_order_relaxed;
    live_.time.store(tick.time, kRelaxed);
    live_.phase.store(trial_.phase(), kRelaxed);
    live_.phase_begin.store(trial_.stretches()[trial_.phase()].begin, kRelaxed);
    if (experiment_.watch) live_.watch.store(experiment_.watch->value.evaluate(trial_.samples()), kRelaxed);
    bool lost = false;
    for (std::size_t f = 0; f < contact.fingers.size(); ++f) {
      lost = lost || !device.fingers[f].valid;
      live_.force[f].store(contact.fingers[f].normal_force, kRelaxed);
      live_.mode[f].store(static_cast<std::int32_t>(contact.fingers[f].mode), kRelaxed);
    }
    live_.device_lost.store(lost, kRelaxed);
    if ((command.status & kOutputMagnitude) != 0) clipped_ += tick.period;
    live_.clipped.store(clipped_, kRelaxed);
  }
  std::vector<std::string> stages() const override { return {"copy the values that the operator sees"}; }

 private:
  const Trial& trial_;
  const Experiment& experiment_;
  TrialLive& live_;
  double clipped_ = 0;
};

}  // namespace presa::experiment
