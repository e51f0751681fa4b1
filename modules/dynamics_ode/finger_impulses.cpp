#include "modules/dynamics_ode/finger_impulses.h"

#include <algorithm>

namespace presa::ode {

FingerImpulses::FingerImpulses(const Scene& scene)
    : bodies_per_finger_(std::min<std::size_t>(scene.bodies.size(), kMaxNearBodies)) {
  makeRoom(scene.devices.size());
}

void FingerImpulses::makeRoom(std::size_t fingers) {
  if (fingers <= force_.size()) return;
  force_.resize(fingers, Vec3::Zero());
  impulse_.resize(fingers, Vec3::Zero());
  touches_ = BoundedList<FingerImpulse>(fingers * bodies_per_finger_);
  renewed_.resize(touches_.capacity());
}

void FingerImpulses::begin(double time) {
  time_ = time;
  setForcesToZero();
  std::ranges::fill(renewed_, 0);
}

void FingerImpulses::setForcesToZero() { std::ranges::fill(force_, Vec3::Zero()); }

void FingerImpulses::add(const FingerJoints& joints, double h, int substeps) {
  for (std::size_t i = 0; i < joints.count(); ++i) {
    const Vec3 force = joints.force(i);
    const std::size_t finger = joints.finger(i);
    force_[finger] += force / substeps;
    impulse_[finger] += h * force;
    touch(finger, joints.body(i), h * force);
  }
}

void FingerImpulses::add(const OwedImpulses& owed, double period) {
  for (const OwedImpulses::Owed& one : owed.all()) {
    if (!one.moves) continue;
    const auto finger = static_cast<std::size_t>(one.finger);
    force_[finger] += one.owed() / period;
    impulse_[finger] += one.owed();
    if (one.touches) touch(finger, static_cast<std::size_t>(one.body), one.owed());
  }
}

void FingerImpulses::touch(std::size_t finger, std::size_t body, const Vec3& impulse_W) {
  const auto f = static_cast<std::int32_t>(finger), b = static_cast<std::int32_t>(body);
  const auto same = [&](const FingerImpulse& one) { return one.finger == f && one.body == b; };
  FingerImpulse* one = std::ranges::find_if(touches_, same);
  if (one == touches_.end()) one = touches_.add({.finger = f, .body = b, .since = time_});
  if (one == nullptr) return;
  one->impulse_W += impulse_W;
  renewed_[static_cast<std::size_t>(one - touches_.begin())] = 1;
}

void FingerImpulses::end() {
  for (std::size_t i = touches_.size(); i-- > 0;) {
    if (renewed_[i] == 0) touches_.remove(i);  // the last one, renewed, takes its place
  }
}

void FingerImpulses::write(ObjectState& out) const {
  out.finger_impulse_W = impulse_;
  out.touches = touches_;
}

}  // namespace presa::ode
