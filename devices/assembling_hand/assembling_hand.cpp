#include "devices/assembling_hand/planner.h"
#include "devices/hand/hand_plugin.h"
#include "devices/hand/ideal_device.h"
#include "devices/hand/planned_finger.h"
#include "framework/device/device_plugin.h"

namespace presa::assembling {
namespace {

std::unique_ptr<Hand> createHand(const Thimble& thimble, const std::shared_ptr<const World>& shared_world,
                                 const RunOptions& /*options*/, Diagnostics& diagnostics) {
  const World& world = *shared_world;
  const DeviceBinding& binding = thimble.binding;
  const std::size_t before = diagnostics.errorCount();
  const double side = sideOf(binding, diagnostics);
  HandSettings settings = readImpedance(binding, world, thimble.carried, {}, diagnostics);
  if (!world.scene.assembly) {
    diagnostics.error(448, binding.where, "role '" + binding.role + "': the scene has no <assembly> to build",
                      "use another driver, or a scene with an <assembly> (modules/assembly/README.md)");
  }
  if (diagnostics.errorCount() > before) return nullptr;
  return makePlannedFinger({.plan = std::make_unique<Planner>(shared_world, fingertipOf(binding, world)),
                            .side = side,
                            .settings = std::move(settings),
                            .phases = Planner::phaseNames(),
                            .model = "fingers that assemble by a plan: no person"});
}

const HandPlugin kHand{.create = createEachHand<createHand>};
const DevicePlugin kPlugin{
    .name = "assembling_hand", .create = createIdeal<createEachHand<createHand>>, .rating = kImaginedRating};

}  // namespace
}  // namespace presa::assembling

PRESA_DEVICE_PLUGIN(presa::assembling::kPlugin)
PRESA_HAND_PLUGIN(presa::assembling::kHand)
