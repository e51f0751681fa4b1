#pragma once
#include <atomic>
#include <memory>

#include "framework/device/wrapped_device.h"

namespace presa::temple {

/// A finger that is the visitor's, and a simulated hand's while nobody is there. At every change of hands it is gone for kPause: no force,
/// no contact, so that it may be elsewhere afterwards.
class SharedFinger final : public WrappedDevice {
 public:
  /// `visitor`: the visitor's device.
  explicit SharedFinger(std::unique_ptr<Device> visitor) : WrappedDevice(std::move(visitor)) {}

  static constexpr double kPause = 0.3;    ///< [s]
  static constexpr double kMoves = 0.015;  ///< a visitor who is there moves the device so far [m]

  /// Main thread, the run going on: from the next tick on that hand moves the finger; null: the visitor. The hand before it is
  /// freed with the next one.
  void give(std::unique_ptr<Device> hand);
  /// The visitor's device was moved, or a button of it pressed, since the hand has the finger. Any thread.
  bool visitorMoved() const noexcept { return moved_.load(std::memory_order_relaxed); }

  FingerInput read(const Tick& tick) noexcept override;
  void write(const Vec3& f_H_W, const Tick& tick) noexcept override;
  bool looks() const override { return true; }
  void see(const ObjectState& objects, const Tick& tick) noexcept override;

 private:
  void change(const Tick& tick) noexcept;
  /// A hand's time begins when it gets the finger.
  Tick sinceChange(const Tick& tick) const noexcept;

  std::unique_ptr<Device> hand_, last_;  // main thread
  std::atomic<Device*> given_{nullptr};
  std::atomic<bool> moved_{false};
  // haptic thread
  Device* moving_ = nullptr;  // null: the visitor
  Tick changed_;
  double back_at_ = 0;  // [s]
  FingerInput left_;    // what the visitor's device said when the hand got the finger
  bool left_known_ = false;
};

}  // namespace presa::temple
