#include "framework/record/record_plugin/reader.h"

#include <algorithm>

#include "framework/diagnostics/refuse.h"
#include "framework/record/record_plugin/table_reader.h"

namespace presa::record {
namespace {

std::vector<std::vector<FingerRow>> readFingers(hid_t file) {
  const Table columns = subset(fingerTable(), {"index", "p_WH", "v_WH", "phase", "valid", "f_command_W"});
  std::vector<std::vector<FingerRow>> fingers;
  for (const HapticTable& table : hapticTables(file, "fingers", "finger"))
    fingers.push_back(readRows<FingerRow>(table.dataset, columns));
  if (fingers.size() > kMaxFingers) throw h5::Failure("too many fingers");
  return fingers;
}

/// Ticks for which every finger has its row.
std::size_t commonPrefix(const std::vector<TickRow>& ticks, const std::vector<std::vector<FingerRow>>& fingers) {
  std::size_t count = ticks.size();
  for (const auto& rows : fingers) {
    count = std::min(count, rows.size());
    for (std::size_t i = 0; i < count; ++i) {
      if (rows[i].index != ticks[i].index) count = i;
    }
  }
  return count;
}

DeviceState deviceState(const TickRow& tick, const std::vector<std::vector<FingerRow>>& fingers, std::size_t row) {
  DeviceState state;
  state.time = tick.device_time;
  state.count = tick.device_count;
  state.stop_requested = tick.stop_requested != 0;
  state.rearms = static_cast<std::uint32_t>(tick.rearms);
  for (std::size_t f = 0; f < fingers.size(); ++f) {
    const FingerRow& finger = fingers[f][row];
    state.fingers[f] = {Vec3(finger.p_WH),
                        Vec3(finger.v_WH),
                        finger.phase,
                        (finger.valid & 1) != 0,
                        (finger.valid & 1) != 0 ? 0 : 1.0,
                        (finger.valid & 2) != 0};  // no age: not to be bridged again
  }
  return state;
}

ForceCommand forceCommand(const TickRow& tick, const std::vector<std::vector<FingerRow>>& fingers, std::size_t row) {
  ForceCommand command;
  command.time = tick.command_time;
  command.count = tick.command_count;
  command.status = tick.output_status;
  command.f_H_W.fill(Vec3::Zero());
  for (std::size_t f = 0; f < fingers.size(); ++f) command.f_H_W[f] = Vec3(fingers[f][row].f_command_W);
  return command;
}

void readHeader(hid_t file, Recording& recording) {
  recording.scene_xml = h5::readText(file, "scene_xml");
  recording.rig_xml = h5::readText(file, "rig_xml");
  recording.scene_file = h5::readStringAttribute(file, "scene_file");
  recording.program_version = h5::readStringAttribute(file, "program_version");
  recording.seed = h5::readCountAttribute(file, "seed");
  recording.realtime = h5::readCountAttribute(file, "realtime") != 0;
  recording.complete = h5::readCountAttribute(file, "complete") != 0;
  recording.dropped = h5::readCountAttribute(file, "dropped");
  recording.haptic_period = h5::readRealAttribute(file, "haptic_period_s");
  if (h5::hasAttribute(file, "force_share")) recording.force_share = h5::readRealAttribute(file, "force_share");
  recording.faults = readFaults(file);
}

/// A table as the file has it: without a column that came with a later version of the format.
Table asIn(hid_t file, Table table, const std::string& added, std::uint64_t version) {
  if (h5::readCountAttribute(file, "format_version") < version)
    std::erase_if(table.columns, [&](const Column& column) { return column.name == added; });
  return table;
}

void readTicks(hid_t file, const std::string& name, Recording& recording) {
  Table table = asIn(file, asIn(file, tickTable(), "surfaces_changed", 3), "rearms", 4);
  table = asIn(file, asIn(file, table, "commanded", 5), "commanded_value", 5);
  auto ticks = readTable<TickRow>(file, "haptic/ticks", table);
  const auto fingers = readFingers(file);
  std::size_t count = commonPrefix(ticks, fingers);
  const Table schedule = asIn(file, scheduleTable(), "made_up", 2);
  for (int g = 0; g < kScheduledGroupCount; ++g) {
    recording.schedule[static_cast<std::size_t>(g)] =
        readTable<ScheduleRow>(file, std::string("schedule/") + toString(static_cast<RateGroup>(g)), schedule);
  }
  auto& haptic = recording.schedule[static_cast<std::size_t>(RateGroup::kHaptic)];
  if (!haptic.empty()) {
    count = std::min(count, haptic.size());
    haptic.resize(count);
  }
  if (count == 0) refuse(607, name, "holds no tick", "the run ended before its first flush");
  recording.first_tick = ticks.front().index;
  for (std::size_t i = 0; i < count; ++i) {
    recording.time.push_back(ticks[i].time);
    recording.device.push_back(deviceState(ticks[i], fingers, i));
    recording.command.push_back(forceCommand(ticks[i], fingers, i));
    recording.surfaces_changed.push_back(ticks[i].surfaces_changed != 0 ? 1 : 0);
    if (ticks[i].commanded != 0)
      recording.commands.push_back({i, static_cast<std::size_t>(ticks[i].commanded - 1), ticks[i].commanded_value});
  }
}

}  // namespace

Recording readRecording(const std::string& file) {
  const h5::Library library;
  try {
    const h5::Handle handle = openRecording(file);
    Recording recording;
    readHeader(handle, recording);
    readTicks(handle, file, recording);
    return recording;
  } catch (const h5::Failure& failure) {
    refuse(608, file, std::string("is damaged: ") + failure.what(), "was it copied completely?");
  }
}

}  // namespace presa::record
