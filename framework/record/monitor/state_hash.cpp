#include "framework/record/monitor/state_hash.h"

namespace presa {
namespace {

constexpr std::size_t kHashedFingers = 8;

}  // namespace

void StateHash::add(const Vec3& v) noexcept {
  add(v.x());
  add(v.y());
  add(v.z());
}

void StateHash::add(const Pose& pose) noexcept {
  add(pose.p);
  add(pose.q.w());
  add(pose.q.x());
  add(pose.q.y());
  add(pose.q.z());
}

void StateHash::add(const DeviceState& state) noexcept {
  add(state.time);
  add(state.count());
  add(state.stop_requested);
  for (std::size_t f = 0; f < state.fingers.size(); ++f) {
    const FingerInput& finger = state.fingers[f];
    add(finger.p_WH);
    add(finger.v_WH);
    add(finger.phase);
    add(finger.valid);
    if (finger.oriented) add(Pose{finger.w_WT, finger.q_WT});
  }
}

void StateHash::add(const FingerContact& finger) noexcept {
  add(static_cast<std::int32_t>(finger.mode));
  add(finger.body);
  add(finger.p_WH);
  add(finger.v_WH);
  add(finger.p_WP);
  add(finger.p_BP);
  add(finger.p_BC);
  add(finger.nhat_B);
  add(finger.nhat_W);
  add(finger.depth);
  add(finger.stiffness);
  add(finger.damping);
  add(finger.friction_static);
  add(finger.friction_dynamic);
  if (finger.tangential_ratio != 1) add(finger.tangential_ratio);
  if (finger.tangential_damping != 0) add(finger.tangential_damping);
  add(finger.normal_force);
  add(finger.tangential_force_W);
  add(finger.f_H_W);
  if (!finger.t_H_W.isZero(0)) add(finger.t_H_W);
}

void StateHash::add(const ContactExchange& state) noexcept {
  add(state.time);
  add(state.count());
  add(state.coverage_lost);
  add(state.pop_through);
  const auto count = state.fingers.size();
  for (std::size_t f = 0; f < count; ++f) add(state.pop_through_by_finger[f]);
  for (std::size_t f = 0; f < count; ++f) add(state.fingers[f]);
}

void StateHash::add(const ObjectState& state) noexcept {
  add(state.time_begin);
  add(state.time_end);
  add(state.count());
  add(state.faults);
  addWord(state.fallback_steps);
  add(state.penetration.points);
  add(state.penetration.mean);
  add(state.penetration.worst);
  const std::vector<Vec3>& impulses = state.finger_impulse_W;
  for (const Vec3& impulse_W : impulses) add(impulse_W);
  // zeros for the fingers of a fixed-size state keep the hashes of earlier versions
  for (std::size_t f = impulses.size(); f < kHashedFingers; ++f) add(Vec3(Vec3::Zero()));
  for (const BodyMotion& body : state.bodies) {
    add(body.X_WB_begin);
    add(body.X_WB_end);
    add(body.v_WB);
    add(body.w_WB);
    add(body.asleep);
  }
}

}  // namespace presa
