#pragma once
#include <algorithm>
#include <memory>

#include "framework/device/device_modules.h"
#include "framework/device/wrapped_device.h"

namespace presa::faults {

/// Forces written to a device.
struct Meter {
  Vec3 force = Vec3::Zero();  ///< current force [N]
  double largest = 0;         ///< max force [N]; NaN once any force was NaN
  double largest_step = 0;    ///< max change between two writes [N]
};

/// A wrapper that records the forces written to a device.
class MeteredDevice final : public WrappedDevice {
 public:
  MeteredDevice(std::unique_ptr<Device> device, Meter& meter) : WrappedDevice(std::move(device)), meter_(meter) {}
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override {
    const double force = F_H_W.f.norm();
    meter_.largest = force > meter_.largest || !(force == force) ? force : meter_.largest;
    meter_.largest_step = std::max(meter_.largest_step, (F_H_W.f - meter_.force).norm());
    meter_.force = F_H_W.f;
    inner().write(F_H_W, tick);
  }

 private:
  Meter& meter_;
};

}  // namespace presa::faults
