#include "apps/studies/cost/joint_watch.h"

#include <algorithm>

namespace presa::cost {

JointWatch::JointWatch(const Scene& scene, const Evidence& evidence)
    : motion_(scene), from_(evidence.compared_from), to_(evidence.compared_to), bodies_(scene.bodies.size()) {}

void JointWatch::observe(const ObjectState& objects) {
  if (motion_.count() == 0 || !(objects.time_end > objects.time_begin) || objects.bodies.size() < bodies_) return;
  if (objects.time_end < from_ || objects.time_end >= to_) return;
  motion_.follow([&](std::size_t body) { return objects.bodies[body].X_WB_end; });
  ++steps_;
  for (std::size_t j = 0; j < motion_.count(); ++j) {
    const JointOpening opening = openingOf(motion_.joint(j), motion_.pose(j));
    widest_.distance = std::max(widest_.distance, opening.distance);
    widest_.angle = std::max(widest_.angle, opening.angle);
  }
}

void JointWatch::finish(Evidence& evidence) const {
  if (steps_ == 0) return;
  evidence.joint_gap = widest_.distance;
  evidence.joint_tilt = widest_.angle;
}

}  // namespace presa::cost
