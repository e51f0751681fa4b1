#include "modules/dynamics_ode/energy_book.h"

#include <algorithm>

#include "framework/geometry/index.h"

namespace presa::ode {

void EnergyBook::settle(const BodySet& bodies, Islands& islands, const FingerJoints& fingers,
                        const std::vector<ContactProblem::Motor>* motors, const JointSet* links) {
  std::fill(gain_.begin(), gain_.end(), 0);
  std::fill(unknown_.begin(), unknown_.end(), 0);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.awake(i) && bodies.hasAddedInertia(i)) unknown_[islands.of(i)] = 1;
  }
  for (const auto& list : {motors, &fingers.motors()}) {
    if (list == nullptr) continue;
    for (const ContactProblem::Motor& motor : *list) unknown_[islands.of(index(motor.body))] = 1;
  }
  for (std::size_t i = 0; links != nullptr && i < links->size(); ++i) {
    if (const std::size_t body = links->movingBody(i, bodies); body < bodies.size()) unknown_[islands.of(body)] = 1;
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies.awake(i) || unknown_[islands.of(i)] != 0) continue;
    gain_[islands.of(i)] += bodies.energyGain(i, gravity_W_) - bodies.externalWork(i);
  }
  for (std::size_t i = 0; i < fingers.count() && !fingers.areForces(); ++i) {
    const std::size_t body = fingers.body(i);
    gain_[islands.of(body)] -= fingers.force(i).dot(bodies.movedSinceBegin(body, fingers.row(i).p_WP));
  }
  double step = 0;
  for (std::size_t i = 0; i < gain_.size(); ++i) {
    if (unknown_[i] == 0) step += std::max(0.0, gain_[i]);
  }
  created_ += step;
  worst_step_ = std::max(worst_step_, step);
}

}  // namespace presa::ode
