#pragma once
#include <memory>

#include "framework/device/device.h"

namespace presa {

/// Decorator base: forwards every call to the wrapped device; a subclass overrides the calls that it changes.
class WrappedDevice : public Device {
 public:
  explicit WrappedDevice(std::unique_ptr<Device> device) : device_(std::move(device)) {}  ///< owns `device`

  void open() override { device_->open(); }
  void close() noexcept override { device_->close(); }
  FingerInput read(const Tick& tick) noexcept override { return device_->read(tick); }
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override { device_->write(F_H_W, tick); }
  void rearm() noexcept override { device_->rearm(); }
  void reopen(const std::atomic<bool>& stop) override { device_->reopen(stop); }
  bool looks() const override { return device_->looks(); }
  void see(const ObjectState& objects, const Tick& tick) noexcept override { device_->see(objects, tick); }
  bool measuresOrientation() const override { return device_->measuresOrientation(); }
  int buttons() const override { return device_->buttons(); }
  bool points() const override { return device_->points(); }
  void point(const PointerState& pointer, const Tick& tick) noexcept override { device_->point(pointer, tick); }
  std::string model() const override { return device_->model(); }
  std::vector<DeviceFact> facts() const override { return device_->facts(); }
  std::vector<std::string> phases() const override { return device_->phases(); }
  std::vector<double> phaseTimes() const override { return device_->phaseTimes(); }
  std::vector<PhaseIntent> phaseIntents() const override { return device_->phaseIntents(); }
  double damping() const override { return device_->damping(); }
  double turnDamping() const override { return device_->turnDamping(); }
  double mass() const override { return device_->mass(); }
  std::vector<std::string> notes() const override { return device_->notes(); }

 protected:
  Device& inner() noexcept { return *device_; }              ///< the wrapped device
  const Device& inner() const noexcept { return *device_; }  ///< the wrapped device

 private:
  std::unique_ptr<Device> device_;
};

}  // namespace presa
