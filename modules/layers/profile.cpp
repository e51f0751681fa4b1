#include "modules/layers/profile.h"

#include <algorithm>
#include <stdexcept>

namespace presa {

LayerProfile::LayerProfile(double skin, double core, double thickness, double transition)
    : skin_(skin), core_(core), thickness_(thickness), transition_(transition) {
  if (core < skin)
    throw std::invalid_argument("the core is softer than the skin; friction on a hard crust would gain energy");
}

double LayerProfile::tangent(double depth) const noexcept {
  return skin_ + (core_ - skin_) * std::clamp((depth - thickness_) / transition_, 0.0, 1.0);
}

// The skin's force, and the area between the stiffness and the skin's: a triangle, then a rectangle.
double LayerProfile::force(double depth) const noexcept {
  const double below = std::max(0.0, depth - thickness_), within = std::min(below, transition_);
  return skin_ * depth + (core_ - skin_) * (0.5 * within * within / transition_ + (below - within));
}

double LayerProfile::secant(double depth) const noexcept { return depth > thickness_ ? force(depth) / depth : skin_; }

}  // namespace presa
