#pragma once
#include <array>
#include <atomic>

#include "framework/core/graph/port.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/object_state.h"

namespace presa {

/// Values for the status line. Written by the haptic thread, read by the main thread a few times a second;
/// each value is consistent, but the values may come from two different ticks.
struct LiveValues {
  std::atomic<std::int32_t> phase{-1};
  std::array<std::atomic<double>, kMaxFingers> normal_force{};
  std::array<std::atomic<std::int32_t>, kMaxFingers> mode{};
  std::atomic<std::uint32_t> losses{0};         ///< ContactExchange::coverage_lost and pop_through
  std::atomic<std::uint32_t> object_faults{0};  ///< ObjectFault bits seen
  std::atomic<double> object_fault_time{-1};    ///< time of the last new fault [s]
};

/// Observer module at the haptic rate, for the status line.
class LiveTap final : public Module {
 public:
  explicit LiveTap(LiveValues& values) : Module("live_tap", RateGroup::kHaptic), values_(values) {}

  void step(const Tick& tick) noexcept override {
    values_.phase.store(device_->fingers[0].phase, std::memory_order_relaxed);
    for (std::size_t f = 0; f < static_cast<std::size_t>(contact_->count); ++f) {
      values_.normal_force[f].store(contact_->fingers[f].normal_force, std::memory_order_relaxed);
      values_.mode[f].store(static_cast<std::int32_t>(contact_->fingers[f].mode), std::memory_order_relaxed);
    }
    values_.losses.store(contact_->coverage_lost + contact_->pop_through, std::memory_order_relaxed);
    if (const std::uint32_t faults = object_faults_ | objects_->faults; faults != object_faults_) {
      object_faults_ = faults;
      values_.object_fault_time.store(tick.time, std::memory_order_relaxed);
      values_.object_faults.store(faults, std::memory_order_release);
    }
  }
  std::vector<std::string> stages() const override { return {"copy forces and modes for the terminal"}; }

 private:
  LiveValues& values_;
  std::uint32_t object_faults_ = 0;
  In<DeviceState> device_{*this, "device_state", In<DeviceState>::Optional{}};
  In<ContactExchange> contact_{*this, "contact_exchange", In<ContactExchange>::Optional{}};
  In<ObjectState> objects_{*this, "object_state", In<ObjectState>::Optional{}};
};

}  // namespace presa
