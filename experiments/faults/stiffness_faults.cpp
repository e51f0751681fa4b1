#include <array>
#include <cmath>
#include <cstdio>

#include "experiments/faults/metered_devices.h"
#include "experiments/faults/scene_faults.h"
#include "experiments/faults/temporary_file.h"
#include "experiments/study/experiment_file.h"
#include "framework/session/load_world.h"
#include "framework/session/run.h"

namespace presa::faults {
namespace {

constexpr double kMass = 0.1, kHand = 300;  // fingertip [kg]; the hand that holds it [N/m]

/// Instability of a sampled wall: a finger m x'' + b x' = -K x[k] with period T and held force. True when an eigenvalue
/// of the exact discrete step lies outside the unit circle.
bool grows(double stiffness, double damping, double period) {
  const double decay = std::exp(-damping * period / kMass), travel = (1 - decay) * kMass / damping;
  const double push = (period - travel) / damping, kick = (1 - decay) / damping;  // of 1 N on x, on v
  const double trace = 1 - stiffness * push + decay;
  const double determinant = (1 - stiffness * push) * decay + stiffness * kick * travel;
  // both eigenvalues lie inside the unit circle [Jury]
  return !(std::abs(determinant) < 1 && std::abs(trace) < 1 + determinant);
}

double oracle(double damping, double period) {
  double low = 0, high = 1;
  while (!grows(high, damping, period)) high *= 2;
  while (high - low > 1e-9 * high) (grows((low + high) / 2, damping, period) ? high : low) = (low + high) / 2;
  return low;
}

std::string rigWith(double damping) {
  const std::string motion = experimentFile("../config/motions/pinch_cube.xml");
  std::string rig = "<?xml version=\"1.0\"?>\n<rig version=\"1.0\" name=\"soft\">\n";
  for (const char* role : {"thumb", "index"}) {
    std::array<char, 1024> text;
    std::snprintf(text.data(), text.size(),
                  "<device role=\"%s\" driver=\"scripted\"><set key=\"motion\" value=\"%s\"/>"
                  "<set key=\"damping\" value=\"%.6f\"/></device>\n",
                  role, motion.c_str(), damping);
    rig += text.data();
  }
  return rig + "</rig>\n";
}

void requireClamped(const Loaded& loaded, const Diagnostics& findings, double asked, double max, Outcome& outcome) {
  bool warned = false;
  for (const Diagnostic& finding : findings.all())
    warned = warned || (finding.code == 454 && finding.message.find("K_max") != std::string::npos);
  for (const Body& body : loaded.world->scene.bodies) {
    const Material& material = loaded.world->scene.materialOf(body);
    if (material.name != "rubber") continue;
    if (material.stiffness > 0.5 * max) outcome.broken.emplace_back("stiffer than half of the stable stiffness");
    if (asked < 0.49 * max && (material.stiffness != asked)) outcome.broken.emplace_back("changed without need");
    if (asked > 0.5 * max && !warned) outcome.broken.emplace_back("no warning that names the bound");
  }
}

/// Grasps with the rig's own drivers and a force meter on each.
void grasp(Loaded loaded, Outcome& outcome) {
  std::array<Meter, 2> meters;
  for (std::size_t f = 0; f < loaded.devices.size(); ++f)
    loaded.devices[f] = std::make_unique<MeteredDevice>(std::move(loaded.devices[f]), meters[f]);
  loaded.options.duration = 2;
  RunControl control;
  Run run(std::move(loaded), control);
  run.execute();
  const DeviceLimits& limits = run.world().scene.devices[0].limits;
  const double slew = limits.force_rate * run.executor().rates().period(RateGroup::kHaptic);
  for (const Meter& meter : meters) {
    if (!(meter.largest <= limits.force * (1 + 1e-9))) outcome.broken.emplace_back("a force above the limit");
    if (!(meter.largest > 0)) outcome.broken.emplace_back("nothing was touched");
    outcome.step = std::max(outcome.step, meter.largest_step / slew);  // 1: the full slew limit
  }
}

}  // namespace

Outcome tooStiff(RandomStream& random) {
  static constexpr std::array kRates{600.0, 1000.0, 2000.0, 4000.0};
  const double rate = kRates[random.below(4)], damping = std::round(random.logNormal(3, 0.7) * 1e3) / 1e3;
  const double asked = std::round(random.logNormal(2 * damping * rate, 1));
  const TemporaryFile rig(rigWith(damping), ".xml");
  Diagnostics findings;
  RunOptions options;
  options.bound_stiffness = true;
  std::array<char, 64> stiffness, haptic;
  std::snprintf(stiffness.data(), stiffness.size(), "material/rubber/stiffness=%.17g", asked);
  std::snprintf(haptic.data(), haptic.size(), "rates/haptic=%.0f", rate);
  // make the table soft: its own stiffness warning would hide the expected one
  Loaded loaded = loadWorld({experimentFile("../config/scenes/cube.xml"),
                             rig.path(),
                             {stiffness.data(), haptic.data(), "material/wood/stiffness=1"}},
                            options, findings);
  if (findings.hasErrors()) throw InputError(findings);
  Outcome outcome;
  requireClamped(loaded, findings, asked, oracle(damping, 1 / rate), outcome);
  grasp(std::move(loaded), outcome);
  return outcome;
}

}  // namespace presa::faults
