#pragma once
#include <atomic>
#include <future>
#include <memory>
#include <string>

#include "framework/device/device.h"
#include "framework/walls/head_watch.h"

namespace presa {

/// The head before the walls of a CAVE, read from the one device of a rig: a tracker, or a motion in place of one. The
/// device's world is the frame of the walls' file. A lost device is reopened in the background. Thread: one.
class HeadTracker {
 public:
  /// Opens the device. `rest`: the head before its first sample. Throws InputError: findings of the rig, E766 a rig
  /// that has not one device, or one that does not measure orientation.
  HeadTracker(const std::string& rig, const Pose& rest);
  ~HeadTracker();

  /// The head; `time`: simulated time of the run [s], at which a scripted head moves; `now_ns`: CLOCK_MONOTONIC.
  const Pose& update(double time, std::int64_t now_ns);
  /// The head that the walls show already; call before the first update().
  void startFrom(const Pose& X_KHead) { watch_ = walls::HeadWatch(X_KHead); }
  bool lost() const noexcept { return watch_.lost(); }
  std::uint32_t losses() const noexcept { return watch_.losses(); }

 private:
  void bringBack(std::int64_t now_ns);

  std::unique_ptr<Device> device_;
  walls::HeadWatch watch_;
  std::future<void> reopening_;
  std::atomic<bool> stop_{false};
  std::int64_t tried_ns_ = 0;
};

}  // namespace presa
