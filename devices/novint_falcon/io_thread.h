#pragma once
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "devices/novint_falcon/link.h"
#include "framework/core/exchange/latest_value.h"
#include "framework/core/schedule/tick.h"

namespace presa::falcon {

/// The thread that talks to one Falcon. It wakes every 0.25 ms at absolute deadlines, steps the link and sleeps again.
/// It never spins, because the kernel throttles a spinning SCHED_FIFO thread for 50 ms per second. It shares only the
/// latest sample and the latest force with the haptic thread, both wait-free.
class FalconIo {
 public:
  /// Starts the thread, which starts up the device.
  FalconIo(std::unique_ptr<FalconTransport> transport, std::vector<std::uint8_t> firmware,
           const LinkSettings& settings);
  /// Takes the force to zero, sends zero for a while, then ends.
  ~FalconIo();
  FalconIo(const FalconIo&) = delete;
  FalconIo& operator=(const FalconIo&) = delete;

  /// Latest sample. Haptic thread; wait-free. Invalid when the device is silent, not homed or in a fault, or when the
  /// I/O thread has published nothing for FalconLink::kHold of haptic time.
  LinkSample latest(const Tick& tick) noexcept;
  /// Sets the force on the grip [N, frame D]. Haptic thread; wait-free.
  void push(const Vec3& f_H_D) noexcept { force_.publish(f_H_D, 0); }

  /// State of the link. Main thread.
  LinkStatus status() noexcept;
  /// Haptic thread; wait-free. From now on latest() does not report the fault from before.
  void rearm() noexcept { rearms_.fetch_add(1, std::memory_order_relaxed); }
  /// 0: the thread runs with SCHED_FIFO; -1: still starting up; otherwise the errno of the refusal.
  int priorityRefused() const noexcept { return refused_.load(std::memory_order_relaxed); }

 private:
  void run() noexcept;
  void step(double now) noexcept;
  void raisePriority() noexcept;

  const std::unique_ptr<FalconTransport> transport_;
  const std::vector<std::uint8_t> firmware_;
  FalconLink link_;      // I/O thread
  LinkCommand command_;  // I/O thread
  double silence_ = 0;   // haptic thread: since the last published sample [s]
  LatestValue<LinkSample> sample_;
  LatestValue<LinkStatus> status_;
  LatestValue<Vec3> force_{Vec3::Zero()};
  std::atomic<bool> stop_{false};
  std::atomic<std::uint32_t> rearms_{0}, rearms_done_{0};  // done: contained in the published sample
  std::atomic<int> refused_{-1};
  std::thread thread_;
};

}  // namespace presa::falcon
