#include "framework/record/record_plugin/reader.h"

#include <algorithm>

#include "framework/core/diagnostics/refuse.h"
#include "framework/record/record_plugin/contents.h"

namespace presa::record {
namespace {

FingerInput inputOf(const FingerRow& row) {
  const bool valid = (row.valid & 1) != 0;
  return {.p_WH = Vec3(row.p_WH),
          .v_WH = Vec3(row.v_WH),
          .phase = row.phase,
          .valid = valid,
          .age = valid ? 0 : 1.0,  // old enough that the gap is not bridged a second time
          .lost = (row.valid & 2) != 0};
}

void makeRoom(std::size_t fingers, DeviceState& device, ForceCommand& command) {
  if (device.fingers.size() >= fingers) return;
  device.fingers.resize(fingers);
  command.f_H_W.resize(fingers, Vec3::Zero());
  command.t_H_W.resize(fingers, Vec3::Zero());
}

/// Copies the per-tick values that do not belong to a finger.
void takeTicks(const Contents& contents, Recording& recording) {
  for (std::size_t i = 0; i < contents.count; ++i) {
    const TickRow& tick = contents.ticks[i];
    recording.time.push_back(tick.time);
    DeviceState& device = recording.device[i];
    device.time = tick.device_time;
    device.stop_requested = tick.stop_requested != 0;
    device.rearms = static_cast<std::uint32_t>(tick.rearms);
    ForceCommand& command = recording.command[i];
    command.time = tick.command_time;
    command.status = tick.output_status;
    recording.surfaces_changed.push_back(tick.surfaces_changed != 0 ? 1 : 0);
    if (tick.commanded != 0)
      recording.commands.push_back({i, static_cast<std::size_t>(tick.commanded - 1), tick.commanded_value});
  }
}

void takeHeader(const StoredRecording& stored, Recording& recording) {
  recording.file = stored.name;
  recording.scene_xml = stored.scene_xml;
  recording.scene_file = stored.scene_file;
  recording.rig_xml = stored.rig_xml;
  recording.program_version = stored.program_version;
  recording.seed = stored.seed;
  recording.realtime = stored.realtime;
  recording.complete = stored.complete;
  recording.dropped = stored.dropped;
  recording.force_share = stored.force_share;
  recording.faults = stored.faults;
  recording.haptic_period = stored.haptic_period;
  recording.fingers = stored.fingers.size();
  recording.bodies = stored.scene_bodies;
  recording.inputs = stored.inputs;
}

}  // namespace

Recording readRecording(const std::string& file) {
  Recording recording;
  TakeRows take;
  take.finger = [&](const StoredTable& table, const std::vector<FingerRow>& rows) {
    if (recording.device.size() < rows.size()) {
      recording.device.resize(rows.size());
      recording.command.resize(rows.size());
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      makeRoom(table.place + 1, recording.device[i], recording.command[i]);
      recording.device[i].fingers[table.place] = inputOf(rows[i]);
      recording.command[i].f_H_W[table.place] = Vec3(rows[i].f_command_W);
    }
  };
  take.tool = [&](const StoredTable& table, const std::vector<ToolRow>& rows) {
    const std::size_t count = std::min(rows.size(), recording.device.size());
    for (std::size_t i = 0; i < count; ++i) {
      FingerInput& finger = recording.device[i].fingers[table.place];
      const double(&q)[4] = rows[i].q_WT;
      finger.oriented = true;
      finger.q_WT = Quat(q[0], q[1], q[2], q[3]);
      finger.w_WT = Vec3(rows[i].w_WT);
      recording.command[i].t_H_W[table.place] = Vec3(rows[i].t_command_W);
    }
  };
  take.order = [&](const StoredTable&, const std::vector<OrderRow>& rows) {
    recording.guided = true;
    for (const OrderRow& row : rows)
      if (row.goal != TakenOrders::kNone) recording.orders.push_back({row.tick, row.goal, row.body});
  };
  Contents contents = readContents(file, take);
  takeHeader(contents.stored, recording);
  recording.checksum = contents.checksum;
  recording.first_tick = contents.ticks.front().index;
  recording.schedule = std::move(contents.schedule);
  std::vector<ScheduleRow>& haptic = recording.schedule[static_cast<std::size_t>(RateGroup::kHaptic)];
  // the schedule row of a tick is written after its step, so in a killed run the newest tick may lack it
  if (!recording.complete && recording.first_tick == 0) contents.count = std::min(contents.count, haptic.size());
  if (contents.count == 0) refuse(607, file, "holds no tick", "the run ended before its first flush");
  if (haptic.size() > contents.count) haptic.resize(contents.count);
  recording.left_out = contents.stored.ticks.rows - contents.count;
  recording.device.resize(contents.count);
  recording.command.resize(contents.count);
  takeTicks(contents, recording);
  return recording;
}

}  // namespace presa::record
