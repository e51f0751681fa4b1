#include <algorithm>

#include "devices/clumsy_hand/clumsy_plan.h"
#include "devices/hand/hand_plugin.h"
#include "devices/hand/ideal_device.h"
#include "devices/hand/planned_finger.h"
#include "framework/device/device_plugin.h"

namespace presa::clumsy {
namespace {

std::unique_ptr<Hand> createHand(const Thimble& thimble, const std::shared_ptr<const World>& shared_world,
                                 const RunOptions& options, Diagnostics& diagnostics) {
  const World& world = *shared_world;
  const DeviceBinding& binding = thimble.binding;
  const std::size_t before = diagnostics.errorCount();
  const double side = sideOf(binding, diagnostics);
  HandSettings settings = readImpedance(binding, world, thimble.carried, {}, diagnostics);
  if (std::ranges::none_of(world.scene.bodies, [](const Body& body) { return body.physics && !body.fixed; }))
    diagnostics.error(447, binding.where, "role '" + binding.role + "': the scene has no free body to grab",
                      "use a scene with a body that is not fixed and has a <physics>");
  if (diagnostics.errorCount() > before) return nullptr;
  return makePlannedFinger(
      {.plan = std::make_unique<ClumsyPlan>(shared_world, fingertipOf(binding, world), options.seed),
       .side = side,
       .settings = std::move(settings),
       .phases = ClumsyPlan::phaseNames(),
       .model = "fingers that grab at random: no person"});
}

const HandPlugin kHand{.create = createEachHand<createHand>};
const DevicePlugin kPlugin{
    .name = "clumsy_hand", .create = createIdeal<createEachHand<createHand>>, .rating = kImaginedRating};

}  // namespace
}  // namespace presa::clumsy

PRESA_DEVICE_PLUGIN(presa::clumsy::kPlugin)
PRESA_HAND_PLUGIN(presa::clumsy::kHand)
