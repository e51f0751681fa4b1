#include <optional>

#include "devices/hand/finger_plant.h"
#include "devices/hand/hand_settings.h"
#include "devices/hand/scripted_hand.h"
#include "devices/hand/turn_plant.h"
#include "framework/core/schedule/rates.h"
#include "framework/device/device_plugin.h"

namespace presa {
namespace {

/// A simulated fingertip that follows a motion through its own mass, damping and stiffness, and yields to contact
/// forces. Position control across the grip, force control along it. With a motion that turns, it is a stylus, which
/// yields to torques too.
class ScriptedFinger final : public Device {
 public:
  ScriptedFinger(HandSettings settings, double period)
      : hand_(std::move(settings.motion), settings.impedance.stiffness),
        damping_(settings.impedance.damping),
        mass_(settings.impedance.mass),
        plant_(settings.impedance, period),
        lost_at_(settings.lost_at),
        notes_(std::move(settings.notes)) {
    if (hand_.motion().oriented) turn_.emplace(TurnPlant::Impedance{}, period);
    plant_.reset(hand_.motion().at(0).p_WT);
  }

  FingerInput read(const Tick& tick) noexcept override {
    advance(tick);
    const MotionTarget target = hand_.motion().at(tick.time);
    FingerInput input{plant_.position(), plant_.velocity(), target.phase, tick.time < lost_at_};
    input.buttons = hand_.motion().buttonsIn(target.phase);
    if (turn_) {
      input.oriented = true;
      input.q_WT = turn_->orientation(target.q_WT);
      input.w_WT = turn_->rate(target.w_WT);
    }
    return input;
  }

  void write(const Wrench& F_H_W, const Tick& tick) noexcept override {
    advance(tick);
    held_ = F_H_W;
  }

  std::vector<std::string> phases() const override { return hand_.motion().phase_names; }
  std::vector<double> phaseTimes() const override { return hand_.motion().phase_times; }
  std::vector<PhaseIntent> phaseIntents() const override { return hand_.motion().phase_intents; }
  int buttons() const override { return hand_.motion().buttons(); }
  bool measuresOrientation() const override { return turn_.has_value(); }
  std::string model() const override { return "scripted fingers: no person"; }
  double damping() const override { return damping_; }
  double mass() const override { return mass_; }
  std::vector<std::string> notes() const override { return notes_; }

 private:
  /// Advances to `tick` under the held force; after a stall by more than one period.
  void advance(const Tick& tick) noexcept {
    for (; at_.index < tick.index; ++at_.index, at_.time += tick.period) {
      Vec3 force = held_.f;
      const MotionTarget target = hand_.live(at_.time, tick.period, plant_.position(), held_.f, force);
      plant_.step(target.p_WT, target.v_WT, force);
      if (turn_) turn_->step(held_.t);
    }
    at_ = tick;
  }

  ScriptedHand hand_;
  double damping_, mass_;
  FingerPlant plant_;
  double lost_at_;
  std::vector<std::string> notes_;
  std::optional<TurnPlant> turn_;  // of a stylus
  Tick at_;                        // time of the plant
  Wrench held_;                    // of the device since the last write
};

std::unique_ptr<Device> create(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  HandSettings hand = readHand(binding, world, 0, diagnostics);
  if (diagnostics.errorCount() > before) return nullptr;
  return std::make_unique<ScriptedFinger>(std::move(hand), RateTable(world.scene.rates).period(RateGroup::kHaptic));
}

const DevicePlugin kPlugin{.name = "scripted", .create = createEach<create>, .rating = kImaginedRating};

}  // namespace
}  // namespace presa

PRESA_DEVICE_PLUGIN(presa::kPlugin)
