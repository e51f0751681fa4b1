#pragma once
#include <atomic>
#include <cstddef>
#include <vector>

#include "framework/record/haptic_observer.h"

namespace presa {

/// Values for the status line. Written by the haptic thread, read by the main thread a few times a second;
/// each value is consistent, but the values may come from two different ticks.
struct LiveValues {
  /// Before the run.
  void size(std::size_t fingers) {
    normal_force = std::vector<std::atomic<double>>(fingers);
    mode = std::vector<std::atomic<std::int32_t>>(fingers);
  }

  std::atomic<std::int32_t> phase{-1};
  std::vector<std::atomic<double>> normal_force;  ///< by finger [N]
  std::vector<std::atomic<std::int32_t>> mode;    ///< by finger
  std::atomic<std::uint32_t> losses{0};           ///< ContactExchange::coverage_lost and pop_through
  std::atomic<std::uint32_t> object_faults{0};    ///< ObjectFault bits seen
  std::atomic<double> object_fault_time{-1};      ///< time of the last new fault [s]
};

/// Copies forces and modes for the status line.
class LiveObserver final : public HapticObserver {
 public:
  explicit LiveObserver(LiveValues& values) : HapticObserver("live_observer"), values_(values) {}

  void observe(const HapticSample& sample) noexcept override {
    const ContactExchange& contact = sample.contact;
    if (sample.device.count() > 0) values_.phase.store(sample.device.fingers[0].phase, std::memory_order_relaxed);
    for (std::size_t f = 0; f < contact.fingers.size(); ++f) {
      values_.normal_force[f].store(contact.fingers[f].normal_force, std::memory_order_relaxed);
      values_.mode[f].store(static_cast<std::int32_t>(contact.fingers[f].mode), std::memory_order_relaxed);
    }
    values_.losses.store(contact.coverage_lost + contact.pop_through, std::memory_order_relaxed);
    if (sample.objects == nullptr) return;
    if (const std::uint32_t faults = object_faults_ | sample.objects->faults; faults != object_faults_) {
      object_faults_ = faults;
      values_.object_fault_time.store(sample.tick.time, std::memory_order_relaxed);
      values_.object_faults.store(faults, std::memory_order_release);
    }
  }
  std::vector<std::string> stages() const override { return {"copy forces and modes for the terminal"}; }

 private:
  LiveValues& values_;
  std::uint32_t object_faults_ = 0;
};

}  // namespace presa
