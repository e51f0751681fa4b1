#pragma once
#include "devices/hand/finger_plant.h"
#include "devices/hand/hand_plugin.h"
#include "devices/hand/worn_device.h"
#include "framework/core/schedule/rates.h"

namespace presa {

/// A device without mass, friction or steps, on one finger of a hand.
class IdealDevice : public WornDevice {
 public:
  /// `period`: of the haptic thread [s].
  IdealDevice(std::unique_ptr<Hand> worn_by, double period)
      : WornDevice(std::move(worn_by)), plant_(hand().impedance(), period) {
    plant_.reset(hand().start());
    feel();
  }
  FingerInput read(const Tick& tick) noexcept override {
    advance(tick);
    return sample(plant_.position(), plant_.velocity(), tick);
  }
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override {
    advance(tick);
    held_ = F_H_W;
    feel();
  }

 protected:
  Fingertip fingertip() const noexcept override { return {plant_.position(), plant_.velocity(), held_.f}; }
  void move(const HandPush& push, double /*period*/) noexcept override {
    plant_.step(push.p_WT, push.v_WT, push.with(held_.f));
  }
  const Wrench& held() const noexcept { return held_; }

 private:
  FingerPlant plant_;
  Wrench held_;  // of the device since the last write
};

/// DevicePlugin::create of a driver whose devices are ideal ones in the hands that `make`, a HandPlugin::create, gives.
template <auto make>
DeviceList createIdeal(const std::vector<DeviceBinding>& bindings, const std::shared_ptr<const World>& world,
                       const RunOptions& options, Diagnostics& diagnostics) {
  std::vector<Thimble> thimbles;
  for (const DeviceBinding& binding : bindings) thimbles.push_back({.binding = binding});
  DeviceList devices;
  for (std::unique_ptr<Hand>& hand : make(thimbles, world, options, diagnostics)) {
    devices.push_back(nullptr);
    if (!hand) continue;
    devices.back() =
        std::make_unique<IdealDevice>(std::move(hand), RateTable(world->scene.rates).period(RateGroup::kHaptic));
  }
  return devices;
}

}  // namespace presa
