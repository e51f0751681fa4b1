#include "experiments/stability/cases.h"
#include "experiments/stability/fingers.h"
#include "experiments/stability/resting.h"

namespace presa::stability::pressed_on_table {
namespace {

constexpr double kTop = 0.07, kRadius = 0.008, kOpen = 0.003, kDepth = 0.002;

/// One finger that presses the cube from above, off its centre.
DeviceList presser() {
  DeviceList fingers;
  fingers.push_back(std::make_unique<PrescribedFinger>([](double time) {
    const Ramp down = ramp(time, 0.05, 0.35);
    const double z = kTop + kRadius + kOpen - (kOpen + kDepth) * down.value;
    return PrescribedFinger::State{{0.005, 0.003, z}, {0, 0, -(kOpen + kDepth) * down.rate}};
  }));
  return fingers;
}

std::vector<Finding> press(double mass, double stiffness, const Method& method) {
  const std::vector<std::string> sets{"body/cube/physics/mass=" + number(mass),
                                      "material/skin/stiffness=" + number(stiffness)};
  const double force = stiffness * kDepth;
  return settle({.scene = "pressed_on_table.xml",
                 .sets = sets + method,
                 .body = "cube",
                 .force = force,
                 .force_bound = yieldBound(force + 9.81 * mass, kDepth),
                 .oracle = "k depth = " + number(force) + " N, minus the compliance of the table"},
                presser());
}

}  // namespace

Case make() {
  Case result;
  result.name = "pressed_on_table";
  result.title = "A finger presses a cube onto a table";
  result.source =
      "A light body between a stiff finger and a rigid floor: the load on it is up to two thousand times its weight.";
  result.oracle = "The cube stays still, and the finger feels k times its depth.";
  result.scene = "pressed_on_table.xml";
  result.trials = restingTrials(press);
  for (Trial& trial : result.trials) {
    // a single spring against a rigid floor cannot ring
    if (trial.method == explicitCoupling().name) trial.expected = Verdict::kStable;
  }
  return result;
}

}  // namespace presa::stability::pressed_on_table
