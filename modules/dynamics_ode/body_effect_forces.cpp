#include "modules/dynamics_ode/body_effect_forces.h"

namespace presa::ode {

BodyEffectForces::BodyEffectForces(BodyEffects& effects, const World& world)
    : effects_(effects),
      gravity_W_(world.scene.gravity),
      sums_(world.scene.bodies.size()),
      rest_(world.scene.bodies.size()) {}

void BodyEffectForces::add(std::size_t effect, const BodySet& bodies, std::size_t body, double time, double h) {
  const BodySet::Motion motion = bodies.motion(body);
  const BodyEffectWrench wrench =
      effects_.apply(effect, {time, h, static_cast<std::int32_t>(body), bodies.pose(body), motion.p_WCm, motion.v_WCm,
                              motion.w_WB, bodies.mass(body), bodies.inertia(body), gravity_W_});
  BodyEffectWrench& sum = sums_[body];
  sum.f_W += wrench.f_W;
  sum.torque_W += wrench.torque_W;
  sum.rates.damping += wrench.rates.damping;
  sum.rates.stiffness += wrench.rates.stiffness;
  sum.rates.turn_damping += wrench.rates.turn_damping;
  sum.rates.turn_stiffness += wrench.rates.turn_stiffness;
}

// The wrenches on the wanted bodies; all zero when an effect broke its contract.
template <class Wanted>
void BodyEffectForces::sumUp(const BodySet& bodies, double time, double h, const Wanted& wanted) {
  sums_.assign(sums_.size(), {});
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    const std::int32_t own = effects_.bodyOf(e);
    const std::size_t first = own == kNoBody ? 0 : static_cast<std::size_t>(own);
    const std::size_t end = own == kNoBody ? bodies.size() : first + 1;
    for (std::size_t i = first; i < end; ++i) {
      if (wanted(i)) add(e, bodies, i, time, h);
    }
  }
  if (effects_.broken()) sums_.assign(sums_.size(), {});
}

void BodyEffectForces::wakeStirred(BodySet& bodies, Sleep* sleep, double time, double period) {
  if (sleep == nullptr) return;
  sumUp(bodies, time, period, [&](std::size_t i) { return bodies.moves(i) && bodies.asleep(i); });
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Rest& rest = rest_[i];
    if (!bodies.moves(i) || !bodies.asleep(i)) {
      rest.known = false;
      continue;
    }
    const bool same = rest.f_W == sums_[i].f_W && rest.torque_W == sums_[i].torque_W;
    const bool stirred = rest.known && !same;
    rest = {true, sums_[i].f_W, sums_[i].torque_W};
    if (stirred) sleep->wake(bodies, i);
  }
}

void BodyEffectForces::push(BodySet& bodies, double time, double h) {
  sumUp(bodies, time, h, [&](std::size_t i) { return bodies.awake(i); });
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies.awake(i)) continue;
    const BodyEffectWrench& sum = sums_[i];
    const BodySet::Motion motion = bodies.motion(i);
    const double mass = h * (sum.rates.damping + h * sum.rates.stiffness);
    const double inertia = h * (sum.rates.turn_damping + h * sum.rates.turn_stiffness);
    bodies.setAddedInertia(i, mass, inertia);
    bodies.addAtCentre(i, sum.f_W - h * sum.rates.stiffness * motion.v_WCm,
                       sum.torque_W - h * sum.rates.turn_stiffness * motion.w_WB);
    if (mass > 0) bodies.addAtCentre(i, bodies.mass(i) * gravity_W_, Vec3::Zero());
  }
}

}  // namespace presa::ode
