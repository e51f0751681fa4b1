#include "apps/python/binding/snapshot.h"

#include <algorithm>

namespace presa::python {
namespace {

std::array<double, 3> row(const Vec3& v) noexcept { return {v.x(), v.y(), v.z()}; }

void put(const Pose& X_WB, std::size_t i, Snapshot::Bodies& bodies) noexcept {
  bodies.position[i] = row(X_WB.p);
  bodies.orientation[i] = {X_WB.q.w(), X_WB.q.x(), X_WB.q.y(), X_WB.q.z()};
}

}  // namespace

Snapshot::Snapshot(const World& world) {
  const std::size_t body_count = world.scene.bodies.size(), finger_count = world.scene.devices.size();
  for (Rows3* rows : {&bodies.position, &bodies.velocity, &bodies.angular_velocity}) rows->resize(body_count);
  bodies.orientation.resize(body_count);
  bodies.asleep.resize(body_count);
  for (std::size_t i = 0; i < body_count; ++i) put(world.scene.bodies[i].X_WB, i, bodies);
  for (Rows3* rows : {&fingers.position, &fingers.velocity, &fingers.proxy, &fingers.force, &fingers.rendered_force})
    rows->resize(finger_count);
  fingers.depth.resize(finger_count);
  fingers.normal_force.resize(finger_count);
  fingers.mode.resize(finger_count);
  fingers.body.resize(finger_count, kNoBody);
  contacts.resize(finger_count * std::min<std::size_t>(body_count, kMaxNearBodies));
}

void Snapshot::take(const HapticSample& sample) noexcept {
  time = sample.tick.time;
  status = sample.command.status;
  if (sample.objects != nullptr) {
    for (std::size_t i = 0; i < bodies.position.size(); ++i) {
      const auto& motion = sample.objects->bodies[i];
      put(sample.objects->poseAt(static_cast<std::int32_t>(i), time), i, bodies);
      bodies.velocity[i] = row(motion.v_WB);
      bodies.angular_velocity[i] = row(motion.w_WB);
      bodies.asleep[i] = motion.asleep ? 1 : 0;
    }
  }
  contact_count = 0;
  const std::size_t present = std::min(fingers.position.size(), sample.device.fingers.size());
  for (std::size_t f = 0; f < present; ++f) {
    const FingerInput& input = sample.device.fingers[f];
    const FingerContact& contact = sample.contact.fingers[f];
    fingers.position[f] = row(input.p_WH);
    fingers.velocity[f] = row(input.v_WH);
    fingers.proxy[f] = row(contact.p_WP);
    fingers.force[f] = row(sample.command.f_H_W[f]);
    fingers.rendered_force[f] = row(contact.f_H_W);
    fingers.depth[f] = contact.depth;
    fingers.normal_force[f] = contact.normal_force;
    fingers.mode[f] = static_cast<std::int32_t>(contact.mode);
    fingers.body[f] = contact.body;
    for (const ToolContact& part : sample.contact.contactsOf(contact)) add(part, static_cast<std::int32_t>(f));
  }
}

void Snapshot::add(const ToolContact& part, std::int32_t finger) noexcept {
  if (part.body == kNoBody || contact_count == contacts.size()) return;
  const auto body = static_cast<std::size_t>(part.body);
  const auto& p = bodies.position[body];
  const auto& q = bodies.orientation[body];
  const Pose X_WB{{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
  contacts[contact_count++] = {finger,
                               part.body,
                               static_cast<std::int32_t>(part.mode),
                               part.depth,
                               row(X_WB * part.p_BP),
                               row(X_WB.q * part.nhat_B),
                               row(part.f_H_W)};
}

}  // namespace presa::python
