#include "apps/common/grasp_loop.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace presa {

double GraspLoop::naturalFrequency() const {
  return std::sqrt(static_cast<double>(fingers) * stiffness / mass) / (2 * std::numbers::pi);
}

double GraspLoop::explicitMinMass(double period) const {
  return static_cast<double>(fingers) * stiffness * period * period / 4;
}

GraspLoop graspLoop(const World& world, std::size_t body, std::size_t fingers) {
  return {body, fingers, world.inertias[body].mass, world.scene.materialOf(world.scene.bodies[body]).stiffness};
}

std::vector<GraspLoop> graspLoops(const World& world) {
  const Scene& scene = world.scene;
  std::vector<GraspLoop> loops;
  if (scene.devices.size() < 2) return loops;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const bool joined =
        std::ranges::any_of(scene.joints, [i](const Joint& joint) { return joint.body == i || joint.to == i; });
    if (!scene.bodies[i].fixed && scene.bodies[i].haptic && !joined)
      loops.push_back(graspLoop(world, i, scene.devices.size()));
  }
  return loops;
}

}  // namespace presa
