#include "apps/common/run_result.h"

#include <algorithm>

#include "framework/haptics/friction_laws.h"

namespace presa {

void takeMonitor(const Monitor& monitor, RunResult& result) {
  const World& world = *result.world;
  result.contact_points.clear();
  for (std::size_t f = 0; f < world.scene.devices.size(); ++f) {
    result.contact_points.push_back({world.scene.devices[f].role, monitor.fingers()[f], monitor.slipOnsets(f)});
  }
  result.coverage_lost = {monitor.coverageLost(), monitor.firstCoverageLost()};
  result.objects.clear();
  const std::vector<std::int32_t>& traced = monitor.tracedBodies();
  for (std::size_t i = 0; i < world.scene.bodies.size(); ++i) {
    const Body& body = world.scene.bodies[i];
    if (body.fixed) continue;
    const Material& material = world.scene.materialOf(body);
    // another law than the cone does not slip at the static coefficient
    const bool cone = frictionElementOf(world.scene, body.material) == nullptr;
    const auto slot = std::find(traced.begin(), traced.end(), static_cast<std::int32_t>(i));
    result.objects.push_back({body.name, static_cast<std::int32_t>(i),
                              slot == traced.end() ? -1 : static_cast<std::int32_t>(slot - traced.begin()),
                              world.inertias[i].mass, cone ? material.friction_static : 0, material.friction_dynamic,
                              monitor.objects()[i]});
  }
  result.trace = monitor.trace().empty() ? nullptr : &monitor.trace();
  result.state_hash = monitor.hash();
  result.solver_fallbacks = monitor.solverFallbacks();
  result.energy_created = monitor.energyCreated();
  result.stopped_short = monitor.stoppedShort();
  result.too_many_held = monitor.tooManyHeld();
  result.far_lag = monitor.farLag();
  result.simulated_seconds = monitor.simulatedTime();
}

const RunResult::Phase* findPhase(const RunResult& result, const std::string& name) {
  const auto phase = std::find_if(result.phases.begin(), result.phases.end(),
                                  [&](const RunResult::Phase& p) { return p.name == name; });
  return phase == result.phases.end() ? nullptr : &*phase;
}

}  // namespace presa
