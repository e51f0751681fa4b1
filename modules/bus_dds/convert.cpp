#include "modules/bus_dds/convert.h"

#include <algorithm>
#include <array>

namespace presa::bus_dds {
namespace {

presa_dds_Stamp toTopic(const bus::Stamp& stamp) noexcept {
  return {stamp.run, stamp.sequence, stamp.time, stamp.sent_ns};
}
bus::Stamp fromTopic(const presa_dds_Stamp& stamp) noexcept {
  return {stamp.run, stamp.number, stamp.time, stamp.sent_ns};
}
void put(const Vec3& v, presa_dds_Vector& out) noexcept { std::copy_n(v.data(), 3, out); }
void put(const Quat& q, presa_dds_Quaternion& out) noexcept {
  std::ranges::copy(std::array{q.w(), q.x(), q.y(), q.z()}, out);
}
void put(const std::string& name, presa_dds_Name& out) noexcept {
  static_assert(sizeof(presa_dds_Name) == bus::kLongestParameter + 1);
  out[name.copy(out, bus::kLongestParameter)] = '\0';
}
Vec3 vec3(const presa_dds_Vector& v) noexcept { return {v[0], v[1], v[2]}; }
Quat quat(const presa_dds_Quaternion& q) noexcept { return {q[0], q[1], q[2], q[3]}; }

}  // namespace

presa_dds_ObjectState toTopic(const bus::ObjectSample& sample) noexcept {
  presa_dds_ObjectState out{};
  out.body = sample.body;
  out.stamp = toTopic(sample.stamp);
  put(sample.X_WB.p, out.position);
  put(sample.X_WB.q, out.orientation);
  put(sample.v_WB, out.velocity);
  put(sample.w_WB, out.angular_velocity);
  out.asleep = sample.asleep;
  return out;
}

bus::ObjectSample fromTopic(const presa_dds_ObjectState& sample) noexcept {
  bus::ObjectSample out;
  out.body = sample.body;
  out.stamp = fromTopic(sample.stamp);
  out.X_WB = {vec3(sample.position), quat(sample.orientation)};
  out.v_WB = vec3(sample.velocity);
  out.w_WB = vec3(sample.angular_velocity);
  out.asleep = sample.asleep;
  return out;
}

presa_dds_DeviceState toTopic(const bus::FingerSample& sample) noexcept {
  presa_dds_DeviceState out{};
  const FingerContact& contact = sample.contact;
  out.finger = sample.finger;
  out.stamp = toTopic(sample.stamp);
  out.valid = sample.valid;
  put(sample.p_WH, out.hip);
  out.oriented = sample.oriented;
  put(sample.q_WT, out.tool);
  out.mode = static_cast<std::int32_t>(contact.mode);
  out.body = contact.body;
  put(contact.p_WP, out.proxy);
  put(contact.p_BP, out.proxy_on_body);
  put(contact.p_BC, out.touched_on_body);
  put(contact.nhat_B, out.normal_on_body);
  out.friction_static = contact.friction_static;
  out.friction_dynamic = contact.friction_dynamic;
  out.normal_force = contact.normal_force;
  put(contact.tangential_force_W, out.tangential_force);
  put(contact.f_H_W, out.rendered_force);
  put(sample.f_H_W, out.held_force);
  put(sample.t_H_W, out.held_torque);
  return out;
}

bus::FingerSample fromTopic(const presa_dds_DeviceState& sample) noexcept {
  bus::FingerSample out;
  out.finger = sample.finger;
  out.stamp = fromTopic(sample.stamp);
  out.valid = sample.valid;
  out.p_WH = out.contact.p_WH = vec3(sample.hip);
  out.oriented = sample.oriented;
  out.q_WT = quat(sample.tool);
  FingerContact& contact = out.contact;
  contact.mode = static_cast<ContactMode>(std::clamp(sample.mode, 0, 2));
  contact.body = sample.body;
  contact.p_WP = vec3(sample.proxy);
  contact.p_BP = vec3(sample.proxy_on_body);
  contact.p_BC = vec3(sample.touched_on_body);
  contact.nhat_B = vec3(sample.normal_on_body);
  contact.friction_static = sample.friction_static;
  contact.friction_dynamic = sample.friction_dynamic;
  contact.normal_force = sample.normal_force;
  contact.tangential_force_W = vec3(sample.tangential_force);
  contact.f_H_W = vec3(sample.rendered_force);
  out.f_H_W = vec3(sample.held_force);
  out.t_H_W = vec3(sample.held_torque);
  return out;
}

presa_dds_FrameState toTopic(const bus::FrameSample& sample) noexcept {
  const FrameNow& now = sample.now;
  presa_dds_FrameState out{sample.frame, toTopic(sample.stamp), {},        {}, now.zoom, now.doing,
                           now.uses,     now.refusals,          now.losses};
  put(now.X_WF.p, out.position);
  put(now.X_WF.q, out.orientation);
  return out;
}
bus::FrameSample fromTopic(const presa_dds_FrameState& sample) noexcept {
  return {fromTopic(sample.stamp),
          sample.frame,
          {{vec3(sample.position), quat(sample.orientation)},
           sample.zoom,
           sample.doing,
           sample.uses,
           sample.refusals,
           sample.losses}};
}

presa_dds_Beat toTopic(const bus::Heartbeat& heartbeat) noexcept {
  return {toTopic(heartbeat.stamp), heartbeat.objects, heartbeat.fingers, heartbeat.output_status,
          heartbeat.object_faults,  heartbeat.refused, heartbeat.last};
}
bus::Heartbeat fromTopic(const presa_dds_Beat& heartbeat) noexcept {
  return {fromTopic(heartbeat.stamp), heartbeat.objects, heartbeat.fingers, heartbeat.output_status,
          heartbeat.object_faults,    heartbeat.refused, heartbeat.last};
}

presa_dds_Event toTopic(const bus::Event& event) noexcept {
  return {toTopic(event.stamp), static_cast<std::int32_t>(event.kind), event.bits};
}
bus::Event fromTopic(const presa_dds_Event& event) noexcept {
  return {fromTopic(event.stamp), static_cast<bus::Event::Kind>(event.kind), event.bits};
}

SceneInfoTopic::SceneInfoTopic(const bus::RunInfo& run) {
  // the generated types have no const; writing does not modify the texts
  const auto text = [](const std::string& from) { return const_cast<char*>(from.c_str()); };
  for (const bus::RigFrame& frame : run.frames) frames.push_back({text(frame.name), text(frame.parent), frame.zooms});
  for (const std::string& place : run.places) places.push_back(text(place));
  topic = {run.run,
           run.scene_hash,
           run.period,
           run.realtime,
           text(run.scene_name),
           text(run.scene_xml),
           run.commands,
           text(run.mesh_sums),
           run.guide,
           {},
           {}};
  const auto count = [](const auto& from) { return static_cast<std::uint32_t>(from.size()); };
  topic.frames = {count(frames), count(frames), frames.data(), false};
  topic.places = {count(places), count(places), places.data(), false};
}
bus::RunInfo fromTopic(const presa_dds_SceneInfo& run) {
  const auto text = [](const char* from) { return from != nullptr ? std::string(from) : std::string(); };
  bus::RunInfo out{run.run,
                   run.scene_hash,
                   run.period,
                   run.realtime,
                   text(run.scene_name),
                   text(run.scene_xml),
                   run.commands,
                   text(run.mesh_sums),
                   run.guide,
                   {},
                   {}};
  for (std::uint32_t n = 0; n < run.frames._length; ++n) {
    const presa_dds_RigFrame& frame = run.frames._buffer[n];
    out.frames.push_back({text(frame.name), text(frame.parent), frame.zooms});
  }
  for (std::uint32_t n = 0; n < run.places._length; ++n) out.places.push_back(text(run.places._buffer[n]));
  return out;
}

presa_dds_Command toTopic(const bus::Command& command) noexcept {
  presa_dds_Command out{command.run, command.sender, command.number, {}, command.value};
  put(command.parameter, out.parameter);
  return out;
}
bus::Command fromTopic(const presa_dds_Command& command) {
  return {command.run, command.sender, command.number, command.parameter, command.value};
}

presa_dds_Answer toTopic(const bus::Answer& answer) noexcept {
  return {answer.run,   answer.sender, answer.number, static_cast<std::int32_t>(answer.verdict),
          answer.value, answer.min,    answer.max};
}
bus::Answer fromTopic(const presa_dds_Answer& answer) noexcept {
  return {answer.run,   answer.sender, answer.number, static_cast<bus::Answer::Verdict>(answer.verdict),
          answer.value, answer.least,  answer.most};
}

presa_dds_Parameter toTopic(const bus::OpenParameter& parameter) noexcept {
  presa_dds_Parameter out{parameter.run, {}, parameter.value, parameter.min, parameter.max, parameter.of};
  put(parameter.name, out.name);
  return out;
}
bus::OpenParameter fromTopic(const presa_dds_Parameter& parameter) {
  return {parameter.run, parameter.name, parameter.value, parameter.least, parameter.most, parameter.of};
}

presa_dds_WallFrame toTopic(const bus::WallFrame& frame) noexcept {
  presa_dds_WallFrame out{frame.leader, frame.number, frame.run, frame.time, {}, {}, frame.tracked};
  put(frame.X_KHead.p, out.head);
  put(frame.X_KHead.q, out.head_orientation);
  return out;
}

presa_dds_WallDrawn toTopic(const bus::WallDrawn& drawn) noexcept {
  presa_dds_WallDrawn out{drawn.sender, drawn.leader, drawn.number,  {}, drawn.time, drawn.state,
                          {},           {},           drawn.shown_ns};
  put(drawn.wall, out.wall);
  put(drawn.X_KHead.p, out.head);
  put(drawn.X_KHead.q, out.head_orientation);
  return out;
}

bus::WallFrame fromTopic(const presa_dds_WallFrame& frame) noexcept {
  return {frame.leader, frame.number, frame.run, frame.time, {vec3(frame.head), quat(frame.head_orientation)},
          frame.tracked};
}

bus::WallDrawn fromTopic(const presa_dds_WallDrawn& drawn) {
  return {drawn.sender,
          drawn.leader,
          drawn.number,
          drawn.wall,
          drawn.time,
          drawn.state,
          {vec3(drawn.head), quat(drawn.head_orientation)},
          drawn.shown_ns};
}

}  // namespace presa::bus_dds
