#include "devices/admittance/settings.h"
#include "devices/hand/scripted_hand.h"
#include "framework/core/schedule/rates.h"
#include "framework/device/device_plugin.h"

namespace presa {
namespace {

/// A modelled admittance device moved by a scripted hand.
class AdmittanceDevice final : public Device {
 public:
  AdmittanceDevice(const std::string& role, admittance::Settings settings, double period)
      : hand_(std::move(settings.hand.motion), settings.hand.impedance.stiffness),
        impedance_(settings.hand.impedance),
        lost_at_(settings.hand.lost_at),
        damping_(settings.stiffest_wall * period / 2),
        drive_(settings.parameters, period, RandomStream(settings.seed, "force sensor of " + role)),
        notes_(std::move(settings.hand.notes)) {
    drive_.place(hand_.motion().at(0).p_WT);
  }

  FingerInput read(const Tick& tick) noexcept override {
    advance(tick);
    return {drive_.position(), drive_.velocity(), hand_.motion().at(tick.time).phase, tick.time < lost_at_};
  }

  void write(const Wrench& F_H_W, const Tick& tick) noexcept override {
    advance(tick);
    drive_.command(F_H_W.f);
  }

  std::vector<std::string> phases() const override { return hand_.motion().phase_names; }
  std::vector<double> phaseTimes() const override { return hand_.motion().phase_times; }
  std::vector<PhaseIntent> phaseIntents() const override { return hand_.motion().phase_intents; }
  std::string model() const override { return "simulated admittance device, scripted fingers: no device, no person"; }
  /// The damping of an impedance device with the same max wall stiffness.
  double damping() const override { return damping_; }
  std::vector<std::string> notes() const override { return notes_; }

 private:
  /// Advances to `tick` under the held force; after a stall by more than one period.
  void advance(const Tick& tick) noexcept {
    for (; at_.index < tick.index; ++at_.index, at_.time += tick.period) {
      Vec3 push = Vec3::Zero();
      const Vec3 felt = -drive_.handForce();
      const MotionTarget target = hand_.live(at_.time, tick.period, drive_.position(), felt, push);
      drive_.advance({impedance_, target.p_WT, target.v_WT, push});
    }
    at_ = tick;
  }

  ScriptedHand hand_;
  FingerImpedance impedance_;
  double lost_at_, damping_;
  admittance::Drive drive_;
  std::vector<std::string> notes_;
  Tick at_;  // time of the drive
};

std::unique_ptr<Device> create(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics) {
  admittance::Settings settings = admittance::readSettings(binding, world, diagnostics);
  if (!settings.hand.motion) return nullptr;
  return std::make_unique<AdmittanceDevice>(binding.role, std::move(settings),
                                            RateTable(world.scene.rates).period(RateGroup::kHaptic));
}

const DevicePlugin kPlugin{
    .name = "admittance",
    .create = createEach<create>,
    .rating = {.force = 100, .force_rate = 10000, .continuous = 100, .behind = DeviceRating::Behind::kModel}};

}  // namespace
}  // namespace presa

PRESA_DEVICE_PLUGIN(presa::kPlugin)
