#include "modules/dynamics_ode/effect_forces.h"

namespace presa::ode {

void EffectForces::makeRoom(std::size_t bodies) {
  given_.resize(bodies);
  forces_.reserve(bodies);
}

void EffectForces::read(const EffectReactions& reactions, double period, BodySet& bodies, Sleep* sleep) {
  forces_.clear();
  given_.resize(reactions.bodies.size());
  for (std::size_t i = 0; i < reactions.bodies.size(); ++i) {
    const EffectReactions::OnBody& now = reactions.bodies[i];
    const auto body = static_cast<std::size_t>(now.body);
    const Vec3 impulse = now.impulse_W - given_[i].impulse_W;
    const Vec3 angular = now.angular_impulse_W - given_[i].angular_impulse_W;
    given_[i] = now;
    if (now.body < 0 || body >= bodies.size() || !bodies.moves(body)) continue;
    if (!impulse.allFinite() || !angular.allFinite()) continue;
    if (impulse.isZero(0) && angular.isZero(0)) continue;
    if (bodies.asleep(body) && sleep != nullptr) sleep->wake(bodies, body);
    forces_.push_back({body, impulse / period, angular / period});
  }
}

void EffectForces::push(BodySet& bodies) const {
  for (const Force& force : forces_) bodies.addForceAndTorque(force.body, force.f_W, force.torque_W);
}

}  // namespace presa::ode
