#pragma once
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "devices/novint_falcon/link.h"
#include "framework/core/exchange/latest_value.h"
#include "framework/core/schedule/tick.h"

namespace presa::falcon {

/// The thread that talks to one Falcon. It wakes every quarter of a millisecond at absolute deadlines, steps the link, sleeps
/// again, and never spins: a thread that spins at SCHED_FIFO is stopped by the kernel for 50 ms in every second. With the
/// haptic thread it shares nothing but the latest sample and the latest force, both wait-free.
class FalconIo {
 public:
  /// Starts the thread, which begins to bring the device up.
  FalconIo(std::unique_ptr<FalconTransport> transport, std::vector<std::uint8_t> firmware,
           const LinkSettings& settings);
  /// Takes the force to zero, sends that for a while, then ends.
  ~FalconIo();
  FalconIo(const FalconIo&) = delete;
  FalconIo& operator=(const FalconIo&) = delete;

  /// Haptic thread; wait-free. Invalid when the device is silent, not homed or in a fault, or when the thread itself gave no
  /// sign of life for FalconLink::kHold of the haptic thread's own time.
  LinkSample latest(const Tick& tick) noexcept;
  /// Haptic thread; wait-free. Force on the grip [N, frame D].
  void push(const Vec3& f_H_D) noexcept { force_.publish(f_H_D, 0); }

  /// Main thread.
  LinkStatus status() noexcept;
  void rearm() noexcept { rearm_.store(true, std::memory_order_relaxed); }
  /// 0 when the thread runs with SCHED_FIFO, else why not (errno), -1 while the device is brought up.
  int priorityRefused() const noexcept { return refused_.load(std::memory_order_relaxed); }

 private:
  void run() noexcept;
  void step(double now) noexcept;
  void raisePriority() noexcept;

  const std::unique_ptr<FalconTransport> transport_;
  const std::vector<std::uint8_t> firmware_;
  FalconLink link_;      // I/O thread
  LinkCommand command_;  // I/O thread
  double silence_ = 0;   // haptic thread: since the last sign of life [s]
  LatestValue<LinkSample> sample_;
  LatestValue<LinkStatus> status_;
  LatestValue<Vec3> force_;
  std::atomic<bool> stop_{false}, rearm_{false};
  std::atomic<int> refused_{-1};
  std::thread thread_;
};

}  // namespace presa::falcon
