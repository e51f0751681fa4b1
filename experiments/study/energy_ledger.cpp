#include "experiments/study/energy_ledger.h"

#include <algorithm>
#include <cmath>

namespace presa {

EnergyLedger::EnergyLedger(std::shared_ptr<const World> world)
    : world_(std::move(world)),
      last_(world_->scene.bodies.size()),
      p_WH_(world_->scene.devices.size(), Vec3::Zero()),
      f_H_W_(world_->scene.devices.size(), Vec3::Zero()) {
  for (std::size_t i = 0; i < last_.size(); ++i) {
    const Body& body = world_->scene.bodies[i];
    last_[i].w_WB = body.w_WB;
    last_[i].v_WB = body.v_WCm - body.w_WB.cross(body.X_WB.q * world_->inertias[i].p_BCm);
  }
}

// poses at the start of this step with the velocities at the end of the previous step: the same instant
double EnergyLedger::bodies(const ObjectState& objects) const noexcept {
  double energy = 0;
  for (std::size_t i = 0; i < last_.size(); ++i) {
    const Body& body = world_->scene.bodies[i];
    const BodyInertia& inertia = world_->inertias[i];
    if (body.fixed || !(inertia.mass > 0)) continue;
    const Pose& X_WB = objects.bodies[i].X_WB_begin;
    const Vec3 p_BCm_W = X_WB.q * inertia.p_BCm;
    const Vec3 v_WCm = last_[i].v_WB + last_[i].w_WB.cross(p_BCm_W);
    const Vec3 w_B = X_WB.q.conjugate() * last_[i].w_WB;
    energy += 0.5 * inertia.mass * v_WCm.squaredNorm() + 0.5 * w_B.dot(inertia.inertia * w_B);
    energy -= (inertia.mass * world_->scene.gravity + body.force_W).dot(X_WB.p + p_BCm_W);
  }
  return energy;
}

void EnergyLedger::close(double energy) noexcept {
  const double excess = energy - work_;
  if (!open_) {
    start_ = lowest_ = excess;
    open_ = true;
  }
  lowest_ = std::min(lowest_, excess);
  created_ = std::max(created_, excess - lowest_);
  drift_ = std::max(drift_, std::abs(excess - start_));
}

void EnergyLedger::observe(const HapticSample& sample) noexcept {
  double springs = 0;
  for (std::size_t f = 0; f < sample.device.fingers.size(); ++f) {
    const Vec3& p_WH = sample.device.fingers[f].p_WH;
    // the force of the previous tick was held until now
    if (ticked_) work_ -= f_H_W_[f].dot(p_WH - p_WH_[f]);
    p_WH_[f] = p_WH;
    f_H_W_[f] = sample.command.f_H_W[f];
    const FingerContact& contact = sample.contact.fingers[f];
    if (contact.mode != ContactMode::kNone)
      springs += 0.5 * contact.stiffness * (contact.p_WP - contact.p_WH).squaredNorm();
  }
  ticked_ = true;
  if (sample.objects == nullptr || (stepped_ && sample.objects_version == version_)) return;
  const ObjectState& objects = *sample.objects;
  // when observation starts in mid-run, or after steps that ran at once, the state only supplies the velocities
  const bool next = stepped_ && sample.objects_version == version_ + 1;
  const bool known = next || (!stepped_ && !(objects.time_begin > 0));
  if (known && std::abs(objects.time_begin - sample.tick.time) < 0.5 * sample.tick.period)
    close(bodies(objects) + springs);
  std::copy_n(objects.bodies.begin(), last_.size(), last_.begin());
  version_ = sample.objects_version;
  stepped_ = true;
}

}  // namespace presa
