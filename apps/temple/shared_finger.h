#pragma once
#include <atomic>
#include <memory>

#include "framework/device/wrapped_device.h"

namespace presa::temple {

/// A finger moved by the visitor's device, or by a simulated hand while there is no visitor. At every change its
/// samples are invalid for kPause, without force and contact, so that it may continue at another position.
class SharedFinger final : public WrappedDevice {
 public:
  /// `visitor`: the visitor's device.
  explicit SharedFinger(std::unique_ptr<Device> visitor) : WrappedDevice(std::move(visitor)) {}

  static constexpr double kPause = 0.3;    ///< [s]
  static constexpr double kMoves = 0.015;  ///< min displacement of the device that counts as a visitor's touch [m]

  /// Hands the finger to `hand` from the next tick on; null: to the visitor. The previous hand is kept until the next
  /// call, because the haptic thread may still use it. Main thread, during a run.
  void give(std::unique_ptr<Device> hand);
  /// True when the visitor's device was moved or one of its buttons changed since the hand took over. Any thread.
  bool visitorMoved() const noexcept { return moved_.load(std::memory_order_relaxed); }

  FingerInput read(const Tick& tick) noexcept override;
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override;
  bool looks() const override { return true; }
  void see(const ObjectState& objects, const Tick& tick) noexcept override;

 private:
  void change(const Tick& tick) noexcept;
  /// The tick in the hand's time, which begins when it takes over.
  Tick sinceChange(const Tick& tick) const noexcept;

  std::unique_ptr<Device> hand_, last_;  // main thread
  std::atomic<Device*> given_{nullptr};
  std::atomic<bool> moved_{false};
  // haptic thread
  Device* moving_ = nullptr;  // null: the visitor
  Tick changed_;
  double back_at_ = 0;  // [s]
  FingerInput left_;    // the visitor's device when the hand took over
  bool left_known_ = false;
};

}  // namespace presa::temple
