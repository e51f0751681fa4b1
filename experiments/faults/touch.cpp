#include <algorithm>
#include <cmath>

#include "experiments/faults/scene_faults.h"
#include "experiments/study/compliant_finger.h"
#include "experiments/study/study_run.h"
#include "framework/scene/load.h"

namespace presa::faults {
namespace {

/// The fingers are spaced 10 mm apart along y in pairs and move from x = +-60 mm to +-20 mm.
PrescribedFinger::State handAt(std::size_t finger, double time, double seconds) {
  const double side = finger % 2 == 0 ? -1 : 1, from = 0.06, speed = 0.04 / seconds;
  PrescribedFinger::State state;
  state.p_WH = {side * (from - speed * time), 0.01 * static_cast<double>(finger / 2), 0.05};
  state.v_WH = {-side * speed, 0, 0};
  return state;
}

}  // namespace

void touchBriefly(const std::string& scene_file, double seconds, Outcome& outcome) {
  Diagnostics findings;
  const Scene scene = loadScene(scene_file, {}, findings);
  if (findings.hasErrors()) throw InputError(findings);
  double clock = 0;
  std::vector<Transport> transports(scene.devices.size());
  DeviceList fingers;
  for (std::size_t f = 0; f < transports.size(); ++f) {
    fingers.push_back(std::make_unique<CompliantFinger>(
        HandImpedance{}, [=](double time) { return handAt(f, time, seconds); }, clock, transports[f]));
  }
  StudySpec spec;
  spec.scene = scene_file;
  spec.duration = seconds;
  StudyRun run(spec, std::move(fingers));
  run.delay([&](RateGroup, double time) {
    clock = time;
    return false;
  });
  run.observe([&](const HapticSample& sample) {
    for (std::size_t f = 0; f < transports.size(); ++f) {
      const DeviceLimits& limits = scene.devices[f].limits;
      const double force = transports[f].force.norm();
      if (!std::isfinite(force)) outcome.broken.emplace_back("a force that is not finite");
      if (force > limits.force * (1 + 1e-9)) outcome.broken.emplace_back("a force above the limit");
      outcome.step = std::max(outcome.step, transports[f].largest_step / (limits.force_rate * sample.tick.period));
    }
  });
  run.run();
}

}  // namespace presa::faults
