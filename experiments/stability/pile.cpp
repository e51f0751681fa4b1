#include "experiments/stability/pile.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/stability/bodies.h"

namespace presa::stability {

Pile::Pile(const StudySpec& spec, const std::string& body) : run_(spec), body_(bodyNamed(run_.world(), body)) {
  height_.label = "height of " + body;
  run_.observe(atEachStep([this](const ObjectState& state) { see(state); }));
}

// Kinetic energy and energy in gravity of all free bodies.
double Pile::energyOf(const ObjectState& state) const {
  const World& world = run_.world();
  double energy = 0;
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    const BodyInertia& inertia = world.inertias[i];
    if (world.scene.bodies[i].fixed || !(inertia.mass > 0)) continue;
    const BodyMotion& body = state.bodies[i];
    const Vec3 w_B = body.X_WB_end.q.conjugate() * body.w_WB;
    const Vec3 v_WCm = body.v_WB + body.w_WB.cross(body.X_WB_end.q * inertia.p_BCm);
    energy += inertia.mass * (v_WCm.squaredNorm() / 2 - world.scene.gravity.dot(body.X_WB_end * inertia.p_BCm)) +
              w_B.dot(inertia.inertia * w_B) / 2;
  }
  return energy;
}

void Pile::see(const ObjectState& state) {
  const std::vector<Body>& bodies = run_.world().scene.bodies;
  const double energy = energyOf(state);
  if (started_) created_ += std::max(0.0, energy - energy_);
  started_ = true;
  energy_ = energy;
  failed_ = failed_ || state.faults != 0;
  bool asleep = true;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].fixed) continue;
    const double speed = state.bodies[i].v_WB.norm();
    fastest_ = std::max(fastest_, speed);
    if (2 * state.time_end > run_.duration()) late_ = std::max(late_, speed);
    upward_ = std::max(upward_, state.bodies[i].v_WB.z());
    asleep = asleep && state.bodies[i].asleep;
  }
  all_asleep_ = !asleep ? -1 : all_asleep_ < 0 ? state.time_end : all_asleep_;
  const Vec3& p = state.bodies[body_].X_WB_end.p;
  farthest_ = std::max(farthest_, (p - bodies[body_].X_WB.p).norm());
  height_.x.push_back(state.time_end);
  height_.y.push_back(1000 * p.z());
}

Finding Pile::withHeight(Finding finding) const {
  finding.plot_x = "time [s]";
  finding.plot_y = height_.label + " [mm]";
  finding.curves = {decimated(height_)};
  return finding;
}

Finding Pile::energy(double released, double bound_percent) const {
  return withHeight(finding("energy from nothing", 100 * created_ / released, "%", bound_percent,
                            "contacts and friction only take energy; in relation to the energy that can be set free"));
}

Finding Pile::fastest(double bound, const std::string& oracle) const {
  return finding("fastest body", failed_ ? std::numeric_limits<double>::quiet_NaN() : fastest_, "m/s", bound, oracle);
}

Finding Pile::upward(double bound) const {
  return finding("upward speed", upward_, "m/s", bound, "restitution 0: an impact throws nothing up");
}

Finding Pile::displacement(double bound_mm) const {
  return withHeight(finding("displacement", 1000 * farthest_, "mm", bound_mm, "the pile stands where it was put"));
}

Finding Pile::heightLeft(const std::string& oracle) const {
  const double start = 1000 * run_.world().scene.bodies[body_].X_WB.p.z();
  return withHeight(finding("height left", std::max(0.0, 100 * height_.y.back() / start), "%", 50, oracle));
}

Finding Pile::restSpeed() const {
  return finding("fastest body at rest", failed_ ? std::numeric_limits<double>::quiet_NaN() : 1000 * late_, "mm/s", 1,
                 "in the second half nothing moves");
}

Finding Pile::restsWithin(double bound) const {
  const double time = all_asleep_ < 0 ? std::numeric_limits<double>::infinity() : all_asleep_;
  return finding("asleep after", time, "s", bound, "friction and impacts take all energy; then nothing moves");
}

}  // namespace presa::stability
