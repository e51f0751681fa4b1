#include "experiments/stability/cases.h"
#include "experiments/stability/fingers.h"
#include "experiments/stability/resting.h"

namespace presa::stability::pressed_in_corner {
namespace {

constexpr double kHalf = 0.035, kRadius = 0.008, kOpen = 0.003, kDepth = 0.002;

/// Two fingers above the centre of the cube: one pushes along -x, one along -y.
DeviceList pushers() {
  DeviceList fingers;
  for (const Vec3& outward : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())}) {
    fingers.push_back(std::make_unique<PrescribedFinger>([outward](double time) {
      const Ramp push = ramp(time, 0.05, 0.35);
      const double gap = kHalf + kRadius + kOpen - (kOpen + kDepth) * push.value;
      return PrescribedFinger::State{Vec3(0, 0, 0.040) + gap * outward, -(kOpen + kDepth) * push.rate * outward};
    }));
  }
  return fingers;
}

std::vector<Finding> squeeze(double mass, double stiffness, const Method& method) {
  const std::vector<std::string> sets{"body/cube/physics/mass=" + number(mass),
                                      "material/skin/stiffness=" + number(stiffness)};
  const double force = stiffness * kDepth;
  return settle({.scene = "pressed_in_corner.xml",
                 .sets = sets + method,
                 .body = "cube",
                 .force = force,
                 .force_bound = yieldBound(force + 9.81 * mass, kDepth),
                 .oracle = "k depth = " + number(force) + " N, minus the compliance of the walls"},
                pushers());
}

}  // namespace

Case make() {
  Case result;
  result.name = "pressed_in_corner";
  result.title = "Two fingers squeeze a cube into a corner of two walls and a floor";
  result.source =
      "A body with three times more contacts than degrees of freedom: the constraints are redundant and every method "
      "must distribute the load.";
  result.oracle = "The cube stays still, and each finger feels k times its depth.";
  result.scene = "pressed_in_corner.xml";
  result.trials = restingTrials(squeeze);
  return result;
}

}  // namespace presa::stability::pressed_in_corner
