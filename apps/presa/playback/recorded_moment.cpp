#include "apps/presa/playback/recorded_moment.h"

#include <algorithm>
#include <map>

namespace presa {
namespace {

using Column = const std::vector<double>*;

std::array<Column, 3> vectorOf(const RecordedTable& table, const std::string& name) {
  return {&table.values(name + "_x"), &table.values(name + "_y"), &table.values(name + "_z")};
}

Vec3 at(const std::array<Column, 3>& vector, std::size_t row) {
  return {(*vector[0])[row], (*vector[1])[row], (*vector[2])[row]};
}

std::int32_t whole(Column column, std::size_t row) { return static_cast<std::int32_t>((*column)[row]); }

/// Columns of a role's orientation; none when its device measured none.
std::optional<std::array<Column, 4>> orientationOf(const RecordedSamples& samples, const std::string& role) {
  for (const RecordedTable& t : samples.tools) {
    if (t.name == role) return {{&t.values("q_WT_w"), &t.values("q_WT_x"), &t.values("q_WT_y"), &t.values("q_WT_z")}};
  }
  return std::nullopt;
}

}  // namespace

RecordedMoment::RecordedMoment(const RecordedSamples& samples, const World& world) : samples_(samples), world_(world) {
  for (const RecordedTable& t : samples.fingers) {
    fingers_.push_back({vectorOf(t, "p_WH"), vectorOf(t, "v_WH"), vectorOf(t, "p_WP"), vectorOf(t, "p_BP"),
                        vectorOf(t, "p_BC"), vectorOf(t, "nhat_W"), vectorOf(t, "tangential_force_W"),
                        vectorOf(t, "f_rendered_W"), vectorOf(t, "f_command_W"), &t.values("depth"),
                        &t.values("normal_force"), &t.values("phase"), &t.values("valid"), &t.values("mode"),
                        &t.values("body"), orientationOf(samples, t.name)});
  }
  std::map<std::string, std::size_t> bodies;
  for (std::size_t b = 0; b < world.scene.bodies.size(); ++b) bodies.try_emplace(world.scene.bodies[b].name, b);
  for (const RecordedTable& t : samples.bodies) {
    const auto body = bodies.find(t.name);
    if (body == bodies.end()) continue;
    moved_.push_back({body->second,
                      vectorOf(t, "p_WB"),
                      vectorOf(t, "v_WB"),
                      vectorOf(t, "w_WB"),
                      {&t.values("q_WB_w"), &t.values("q_WB_x"), &t.values("q_WB_y"), &t.values("q_WB_z")}});
  }
  for (const RecordedTable& t : samples.frames) {
    frames_.push_back({vectorOf(t, "p_WF"),
                       {&t.values("q_WF_w"), &t.values("q_WF_x"), &t.values("q_WF_y"), &t.values("q_WF_z")},
                       &t.values("zoom"),
                       &t.values("doing"),
                       &t.values("uses"),
                       &t.values("refusals")});
  }
}

std::size_t RecordedMoment::rowAt(double time) const {
  const auto later = std::upper_bound(samples_.time.begin(), samples_.time.end(), time);
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, later - samples_.time.begin() - 1));
}

void RecordedMoment::fillFrames(double time, FrameState& state) const {
  const std::size_t row = rowAt(time);
  state.time = samples_.time[row];
  state.frames.resize(frames_.size());
  for (std::size_t n = 0; n < frames_.size(); ++n) {
    const FrameColumns& frame = frames_[n];
    const auto q = [&](std::size_t i) { return (*frame.q_WF[i])[row]; };
    const auto count = [row](Column column) { return static_cast<std::uint32_t>((*column)[row]); };
    state.frames[n] = {.X_WF = {at(frame.p_WF, row), Quat(q(0), q(1), q(2), q(3)).normalized()},
                       .zoom = (*frame.zoom)[row],
                       .doing = count(frame.doing),
                       .uses = count(frame.uses),
                       .refusals = count(frame.refusals)};
  }
}

void RecordedMoment::fill(double time, ObjectState& objects, DeviceState& device, ContactExchange& contacts,
                          ForceCommand& command) const {
  const std::size_t row = rowAt(time);
  objects.time_begin = objects.time_end = device.time = contacts.time = command.time = samples_.time[row];
  objects.bodies.resize(world_.scene.bodies.size());
  for (std::size_t i = 0; i < world_.scene.bodies.size(); ++i)
    objects.bodies[i].X_WB_begin = objects.bodies[i].X_WB_end = world_.scene.bodies[i].X_WB;
  for (const BodyColumns& moved : moved_) {
    BodyMotion& body = objects.bodies[moved.body];
    const auto q = [&](std::size_t i) { return (*moved.q_WB[i])[row]; };
    body.X_WB_begin = body.X_WB_end = {at(moved.p_WB, row), Quat(q(0), q(1), q(2), q(3)).normalized()};
    body.v_WB = at(moved.v_WB, row);
    body.w_WB = at(moved.w_WB, row);
  }
  device.fingers.resize(fingers_.size());
  contacts.fingers.resize(fingers_.size());
  command.f_H_W.resize(fingers_.size(), Vec3::Zero());
  command.t_H_W.resize(fingers_.size(), Vec3::Zero());
  command.status = samples_.status[row];
  for (std::size_t f = 0; f < fingers_.size(); ++f) {
    fillFinger(fingers_[f], row, objects, device.fingers[f], contacts.fingers[f]);
    command.f_H_W[f] = at(fingers_[f].command, row);
  }
}

void RecordedMoment::fillFinger(const FingerColumns& finger, std::size_t row, const ObjectState& objects,
                                FingerInput& input, FingerContact& contact) const {
  input.p_WH = contact.p_WH = at(finger.p_WH, row);
  input.v_WH = contact.v_WH = at(finger.v_WH, row);
  input.phase = whole(finger.phase, row);
  input.valid = whole(finger.valid, row) != 0;
  if (finger.q_WT) {
    const auto q = [&](std::size_t i) { return (*(*finger.q_WT)[i])[row]; };
    input.oriented = true;
    input.q_WT = Quat(q(0), q(1), q(2), q(3)).normalized();
  }
  contact.mode = static_cast<ContactMode>(whole(finger.mode, row));
  contact.body = whole(finger.body, row);
  contact.p_WP = at(finger.p_WP, row);
  contact.p_BP = at(finger.p_BP, row);
  contact.p_BC = at(finger.p_BC, row);
  contact.nhat_W = contact.nhat_B = at(finger.nhat_W, row);
  contact.depth = (*finger.depth)[row];
  contact.normal_force = (*finger.normal)[row];
  contact.tangential_force_W = at(finger.tangential, row);
  contact.f_H_W = at(finger.rendered, row);
  if (contact.body < 0 || contact.body >= objects.count()) return;
  const auto body = static_cast<std::size_t>(contact.body);
  contact.nhat_B = objects.bodies[body].X_WB_end.q.conjugate() * contact.nhat_W;
  const Material& material = world_.scene.materialOf(world_.scene.bodies[body]);
  contact.stiffness = material.stiffness;
  contact.damping = material.damping;
  contact.friction_static = material.friction_static;
  contact.friction_dynamic = material.friction_dynamic;
}

}  // namespace presa
