#include "devices/hand/finger_plant.h"
#include "devices/hand/hand_settings.h"
#include "devices/hand/scripted_hand.h"
#include "framework/core/schedule/rates.h"
#include "framework/device/device_plugin.h"

namespace presa {
namespace {

/// A simulated fingertip that follows a motion through its own mass, damping and stiffness, and yields to contact
/// forces. Position control across the grip, force control along it.
class ScriptedFinger final : public Device {
 public:
  ScriptedFinger(HandSettings settings, double period)
      : hand_(std::move(settings.motion), settings.impedance.stiffness),
        damping_(settings.impedance.damping),
        plant_(settings.impedance, period),
        lost_at_(settings.lost_at),
        notes_(std::move(settings.notes)) {
    plant_.reset(hand_.motion().at(0).p_WT);
  }

  FingerInput read(const Tick& tick) noexcept override {
    advance(tick);
    return {plant_.position(), plant_.velocity(), hand_.motion().at(tick.time).phase, tick.time < lost_at_};
  }

  void write(const Wrench& F_H_W, const Tick& tick) noexcept override {
    advance(tick);
    force_ = F_H_W.f;
  }

  std::vector<std::string> phases() const override { return hand_.motion().phase_names; }
  std::vector<double> phaseTimes() const override { return hand_.motion().phase_times; }
  std::string model() const override { return "scripted fingers: no person"; }
  double damping() const override { return damping_; }
  std::vector<std::string> notes() const override { return notes_; }

 private:
  /// Advances to `tick` under the held force; after a stall by more than one period.
  void advance(const Tick& tick) noexcept {
    for (; at_.index < tick.index; ++at_.index, at_.time += tick.period) {
      Vec3 force = force_;
      const MotionTarget target = hand_.live(at_.time, tick.period, plant_.position(), force_, force);
      plant_.step(target.p_WT, target.v_WT, force);
    }
    at_ = tick;
  }

  ScriptedHand hand_;
  double damping_;
  FingerPlant plant_;
  double lost_at_;
  std::vector<std::string> notes_;
  Tick at_;                    // time of the plant
  Vec3 force_ = Vec3::Zero();  // [N] force of the device since the last write
};

std::unique_ptr<Device> create(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  refuseUnknownSettings(binding, handKeys(), diagnostics);
  HandSettings hand = readHand(binding, world, 0, diagnostics);
  if (diagnostics.errorCount() > before) return nullptr;
  return std::make_unique<ScriptedFinger>(std::move(hand), RateTable(world.scene.rates).period(RateGroup::kHaptic));
}

const DevicePlugin kPlugin{.name = "scripted",
                           .summary = "simulated fingertip that follows a motion file through a finger's impedance",
                           .create = createEach<create>,
                           .rating = kImaginedRating};

}  // namespace
}  // namespace presa

PRESA_DEVICE_PLUGIN(presa::kPlugin)
