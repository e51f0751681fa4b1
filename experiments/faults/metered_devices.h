#pragma once
#include <algorithm>
#include <memory>

#include "framework/device/device_modules.h"

namespace presa::faults {

/// What was written to a device.
struct Meter {
  Vec3 force = Vec3::Zero();  ///< held now [N]
  double largest = 0;         ///< [N]; NaN stays
  double largest_step = 0;    ///< from one write to the next [N]
};

/// A driver with a meter on its wire.
class MeteredDevice final : public Device {
 public:
  MeteredDevice(std::unique_ptr<Device> device, Meter& meter) : device_(std::move(device)), meter_(meter) {}
  FingerInput read(const Tick& tick) noexcept override { return device_->read(tick); }
  void write(const Vec3& f_H_W, const Tick& tick) noexcept override {
    const double force = f_H_W.norm();
    meter_.largest = force > meter_.largest || !(force == force) ? force : meter_.largest;
    meter_.largest_step = std::max(meter_.largest_step, (f_H_W - meter_.force).norm());
    meter_.force = f_H_W;
    device_->write(f_H_W, tick);
  }
  double damping() const override { return device_->damping(); }

 private:
  std::unique_ptr<Device> device_;
  Meter& meter_;
};

}  // namespace presa::faults
