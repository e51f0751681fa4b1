#pragma once
#include <memory>

#include "apps/temple/help/grasp_help.h"
#include "framework/device/wrapped_device.h"

namespace presa::temple {

/// A fingertip moved with the mouse whose target is helped on its way; forces pass unchanged.
class HelpedFinger final : public WrappedDevice {
 public:
  /// `side` 0: thumb, 1: index.
  HelpedFinger(std::unique_ptr<Device> finger, std::shared_ptr<GraspHelp> help, std::size_t side)
      : WrappedDevice(std::move(finger)), help_(std::move(help)), side_(side) {}

  bool looks() const override { return true; }
  void see(const ObjectState& objects, const Tick& tick) noexcept override {
    help_->see(objects);
    if (inner().looks()) inner().see(objects, tick);
  }
  void point(const PointerState& pointer, const Tick& tick) noexcept override {
    inner().point(help_->target(pointer, tick), tick);
  }
  FingerInput read(const Tick& tick) noexcept override {
    const FingerInput input = inner().read(tick);
    if (input.valid) help_->noteFinger(side_, input.p_WH);
    return input;
  }
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override {
    help_->noteForce(side_, F_H_W.f.norm());
    inner().write(F_H_W, tick);
  }

 private:
  std::shared_ptr<GraspHelp> help_;
  std::size_t side_;
};

/// Wraps a pair of fingertips that is moved with the mouse; other devices stay as they are. Then `help` has an effect.
inline DeviceList helped(DeviceList devices, const std::shared_ptr<GraspHelp>& help) {
  if (devices.size() != 2 || !devices[0]->points() || !devices[1]->points()) return devices;
  for (std::size_t side = 0; side < 2; ++side)
    devices[side] = std::make_unique<HelpedFinger>(std::move(devices[side]), help, side);
  return devices;
}

}  // namespace presa::temple
