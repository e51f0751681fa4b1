#include "apps/studies/cost/rest_watch.h"

#include <algorithm>
#include <limits>

#include "framework/scene/physics_shapes.h"

namespace presa::cost {

RestWatch::RestWatch(const World& world, const Evidence& evidence)
    : world_(world),
      check_(world),
      compared_from_(evidence.compared_from),
      compared_to_(evidence.compared_to),
      steady_from_(evidence.steady_from),
      steady_to_(evidence.steady_to) {
  for (std::size_t i = 0; i < world.scene.bodies.size(); ++i) {
    if (!world.scene.bodies[i].fixed) free_.push_back(i);
  }
}

// Uses the poses at both ends of the step, because engines define velocities differently.
double RestWatch::kineticEnergy(const ObjectState& objects) const {
  const double span = objects.time_end - objects.time_begin;
  double energy = 0;
  for (const std::size_t i : free_) {
    const BodyMotion& motion = objects.bodies[i];
    const BodyInertia& inertia = world_.inertias[i];
    const Vec3 v_WCm = (motion.X_WB_end * inertia.p_BCm - motion.X_WB_begin * inertia.p_BCm) / span;
    const Eigen::AngleAxisd turn(motion.X_WB_begin.q.conjugate() * motion.X_WB_end.q);
    const Vec3 w_B = turn.angle() / span * turn.axis();
    energy += 0.5 * inertia.mass * v_WCm.squaredNorm() + 0.5 * w_B.dot(inertia.inertia * w_B);
  }
  return energy;
}

void RestWatch::observe(const ObjectState& objects) {
  if (!(objects.time_end > objects.time_begin)) return;  // state before the first step
  last_.clear();
  for (const std::size_t i : free_) last_.push_back(objects.bodies[i].X_WB_end.p);
  const bool compared = objects.time_end >= compared_from_ && objects.time_end < compared_to_;
  const bool steady = objects.time_end >= steady_from_ && objects.time_end < steady_to_;
  if (!compared && !steady) return;
  const PenetrationCheck::Result overlap = check_.measure(objects);
  if (compared) {
    deepest_ = std::max(deepest_, overlap.max);
    ++compared_;
  }
  if (!steady) return;
  overlap_ += overlap.mean * static_cast<double>(overlap.pairs);
  pairs_ += overlap.pairs;
  energy_ += kineticEnergy(objects);
  if (steps_++ == 0) start_ = last_;
  for (std::size_t i = 0; i < free_.size(); ++i) drift_ = std::max(drift_, (last_[i] - start_[i]).norm());
}

void RestWatch::finish(Evidence& evidence) const {
  if (check_.pairs() > 0 && compared_ > 0 && steps_ > 0) {
    evidence.penetration = pairs_ > 0 ? overlap_ / static_cast<double>(pairs_) : 0;
    evidence.penetration_max = deepest_;
  }
  const auto& bodies = world_.scene.bodies;
  const auto solid =
      std::count_if(bodies.begin(), bodies.end(), [](const Body& body) { return body.physics.has_value(); });
  if (steps_ == 0 || free_.empty() || solid < 2 || !world_.scene.devices.empty()) return;
  evidence.rest_energy = energy_ / static_cast<double>(steps_);
  evidence.rest_drift = drift_;
}

std::string RestWatch::lost() const {
  const Vec3 down = world_.scene.gravity.normalized();
  double lowest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < world_.scene.bodies.size(); ++i) {
    const Body& body = world_.scene.bodies[i];
    if (!body.fixed) continue;
    for (const PhysicsShape& shape : physicsShapes(body, world_.meshes[i])) {
      const auto* box = std::get_if<Box>(shape.shape);
      if (box != nullptr) lowest = std::max(lowest, down.dot(body.X_WB * shape.X_BG.p) + box->size.norm() / 2);
    }
  }
  if (!std::isfinite(lowest)) return {};
  for (std::size_t i = 0; i < last_.size(); ++i) {
    if (down.dot(last_[i]) > lowest) return world_.scene.bodies[free_[i]].name;
  }
  return {};
}

}  // namespace presa::cost
