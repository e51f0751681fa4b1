#include "devices/admittance/settings.h"
#include "devices/hand/scripted_hand.h"
#include "devices/hand/worn_device.h"
#include "framework/core/schedule/rates.h"
#include "framework/device/device_plugin.h"

namespace presa {
namespace {

/// A modelled admittance device, worn by a hand.
class AdmittanceDevice final : public WornDevice {
 public:
  AdmittanceDevice(std::unique_ptr<Hand> worn_by, const std::string& role, const admittance::Settings& settings,
                   double period)
      : WornDevice(std::move(worn_by)),
        damping_(settings.stiffest_wall * period / 2),
        drive_(settings.parameters, period, RandomStream(settings.seed, "force sensor of " + role)) {
    drive_.place(hand().start());
    feel();
  }

  FingerInput read(const Tick& tick) noexcept override {
    advance(tick);
    return sample(drive_.position(), drive_.velocity(), tick);
  }
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override {
    advance(tick);
    drive_.command(F_H_W.f);
  }
  std::string model() const override { return modelOf("simulated admittance device", hand().model()); }
  /// The damping of an impedance device with the same max wall stiffness.
  double damping() const override { return damping_; }
  double mass() const override { return 0; }

 private:
  Fingertip fingertip() const noexcept override { return {drive_.position(), drive_.velocity(), -drive_.handForce()}; }
  void move(const HandPush& push, double /*period*/) noexcept override {
    drive_.advance({hand().impedance(), push.p_WT, push.v_WT, push.with(Vec3::Zero())});
  }

  double damping_;
  admittance::Drive drive_;
};

std::unique_ptr<Device> create(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics) {
  admittance::Settings settings = admittance::readSettings(binding, world, diagnostics);
  if (!settings.hand.motion) return nullptr;
  return std::make_unique<AdmittanceDevice>(std::make_unique<ScriptedHand>(std::move(settings.hand)), binding.role,
                                            settings, RateTable(world.scene.rates).period(RateGroup::kHaptic));
}

const DevicePlugin kPlugin{
    .name = "admittance",
    .create = createEach<create>,
    .rating = {.force = 100, .force_rate = 10000, .continuous = 100, .behind = DeviceRating::Behind::kModel}};

}  // namespace
}  // namespace presa

PRESA_DEVICE_PLUGIN(presa::kPlugin)
