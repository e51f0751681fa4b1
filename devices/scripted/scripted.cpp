#include <optional>

#include "devices/hand/hand_plugin.h"
#include "devices/hand/ideal_device.h"
#include "devices/hand/scripted_hand.h"
#include "devices/hand/turn_plant.h"
#include "framework/core/schedule/rates.h"
#include "framework/device/device_plugin.h"

namespace presa {
namespace {

/// A stylus: a fingertip along a motion that turns, which yields to torques too.
class ScriptedStylus final : public IdealDevice {
 public:
  ScriptedStylus(std::unique_ptr<ScriptedHand> scripted, double period)
      : IdealDevice(std::move(scripted), period), turn_(TurnPlant::Impedance{}, period) {}

  bool measuresOrientation() const override { return true; }
  FingerInput read(const Tick& tick) noexcept override {
    FingerInput input = IdealDevice::read(tick);
    const MotionTarget target = static_cast<const ScriptedHand&>(hand()).motion().at(tick.time);
    input.oriented = true;
    input.q_WT = turn_.orientation(target.q_WT);
    input.w_WT = turn_.rate(target.w_WT);
    return input;
  }

 private:
  void move(const HandPush& push, double period) noexcept override {
    IdealDevice::move(push, period);
    turn_.step(held().t);
  }

  TurnPlant turn_;
};

/// Null with findings. `carried`: mass of the device that the hand wears [kg].
std::unique_ptr<ScriptedHand> makeHand(const DeviceBinding& binding, const World& world, double carried,
                                       Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  HandSettings settings = readHand(binding, world, carried, diagnostics);
  if (diagnostics.errorCount() > before) return nullptr;
  return std::make_unique<ScriptedHand>(std::move(settings));
}

std::unique_ptr<Device> create(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics) {
  std::unique_ptr<ScriptedHand> hand = makeHand(binding, world, 0, diagnostics);
  if (!hand) return nullptr;
  const double period = RateTable(world.scene.rates).period(RateGroup::kHaptic);
  if (hand->motion().oriented) return std::make_unique<ScriptedStylus>(std::move(hand), period);
  return std::make_unique<IdealDevice>(std::move(hand), period);
}

std::unique_ptr<Hand> createHand(const Thimble& thimble, const std::shared_ptr<const World>& world,
                                 const RunOptions& /*options*/, Diagnostics& diagnostics) {
  return makeHand(thimble.binding, *world, thimble.carried, diagnostics);
}

const DevicePlugin kPlugin{.name = "scripted", .create = createEach<create>, .rating = kImaginedRating};
const HandPlugin kHand{.create = createEachHand<createHand>};

}  // namespace
}  // namespace presa

PRESA_DEVICE_PLUGIN(presa::kPlugin)
PRESA_HAND_PLUGIN(presa::kHand)
