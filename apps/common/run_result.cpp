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
  result.stopped_at = monitor.stoppedAt();
}

std::optional<PhaseSpan> spanOf(const RunResult& result, PhaseIntent intent) {
  std::optional<PhaseSpan> span;
  for (const RunResult::Phase& phase : result.phases) {
    if (phase.intent == intent && !span) span = PhaseSpan{phase.begin, phase.end};
    if (phase.intent == intent) span->end = phase.end;
    if (phase.intent != intent && span) break;
  }
  return span;
}

}  // namespace presa
