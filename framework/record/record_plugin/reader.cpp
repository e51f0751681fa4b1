#include "framework/record/record_plugin/reader.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "framework/diagnostics/refuse.h"
#include "framework/record/record_plugin/recording_file.h"

namespace presa::record {
namespace {

/// The system's own reason when a file cannot be read; HDF5 keeps none.
void checkReadable(const std::string& file) {
  const int fd = open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) refuse(603, file, std::string("cannot be read: ") + std::strerror(errno), "check the name");
  const bool busy = flock(fd, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  close(fd);
  if (busy) refuse(603, file, "is still being written by a run", "wait until that run has ended");
}

h5::Handle openRecording(const std::string& file) {
  checkReadable(file);
  if (H5Fis_hdf5(file.c_str()) <= 0) refuse(604, file, "is not an HDF5 file", "recordings are made with --record");
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) refuse(608, file, "is damaged: HDF5 cannot open it", "was it copied completely?");
  h5::Handle handle(id, H5Fclose, "file");
  if (!h5::hasAttribute(handle, "format") || h5::readStringAttribute(handle, "format") != kFormatName) {
    refuse(605, file, "is an HDF5 file but not a Presa recording", "recordings are made with --record");
  }
  const std::uint64_t version = h5::readCountAttribute(handle, "format_version");
  if (version > kFormatVersion) {
    refuse(606, file,
           "has format version " + std::to_string(version) + "; this program reads up to " +
               std::to_string(kFormatVersion),
           "read it with the version of Presa that recorded it: " + h5::readStringAttribute(handle, "program_version"));
  }
  return handle;
}

/// The rows of a table that can be read, in order. In the file of a killed run the newest chunk may be unreadable
/// (its flush was cut short): the table ends before it, and before the first row whose index does not grow.
template <class Row>
std::vector<Row> readRows(hid_t dataset, const Table& columns) {
  const h5::Handle type = h5::compoundType(columns, h5::Side::kMemory);
  const h5::Handle stored(H5Dget_type(dataset), H5Tclose, "row type");
  for (const Column& column : columns.columns) {
    if (H5Tget_class(stored) != H5T_COMPOUND || H5Tget_member_index(stored, column.name.c_str()) < 0) {
      throw h5::Failure("column " + column.name + " is missing");
    }
  }
  const h5::Handle space(H5Dget_space(dataset), H5Sclose, "table space");
  const hssize_t total = H5Sget_simple_extent_npoints(space);
  if (H5Sget_simple_extent_ndims(space) != 1 || total < 0) throw h5::Failure("a table is not a list of rows");

  std::vector<Row> rows;
  rows.reserve(static_cast<std::size_t>(total));
  for (hsize_t begin = 0; begin < static_cast<hsize_t>(total);) {
    const hsize_t length = std::min<hsize_t>(kBlockRows, static_cast<hsize_t>(total) - begin);
    h5::check(H5Sselect_hyperslab(space, H5S_SELECT_SET, &begin, nullptr, &length, nullptr), "table selection");
    const h5::Handle memory(H5Screate_simple(1, &length, nullptr), H5Sclose, "row space");
    rows.resize(begin + length);
    if (H5Dread(dataset, type, memory, space, H5P_DEFAULT, &rows[begin]) < 0) {
      rows.resize(begin);
      break;
    }
    begin += length;
  }
  const auto out_of_order = [](const Row& a, const Row& b) { return a.index >= b.index; };
  const auto last = std::adjacent_find(rows.begin(), rows.end(), out_of_order);
  if (last != rows.end()) rows.erase(last + 1, rows.end());
  return rows;
}

template <class Row>
std::vector<Row> readTable(hid_t parent, const std::string& name, const Table& columns) {
  const h5::Handle dataset(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, "table " + name);
  return readRows<Row>(dataset, columns);
}

/// Finger tables in the order of the device roles.
std::vector<std::vector<FingerRow>> readFingers(hid_t file) {
  const h5::Handle group(H5Gopen2(file, "haptic/fingers", H5P_DEFAULT), H5Gclose, "group haptic/fingers");
  const Table columns = subset(fingerTable(), {"index", "p_WH", "v_WH", "phase", "valid", "f_command_W"});
  const std::vector<std::string> names = h5::members(group);
  if (names.size() > kMaxFingers) throw h5::Failure("too many fingers");
  std::vector<std::vector<FingerRow>> fingers(names.size());
  std::vector<bool> present(names.size(), false);
  for (const std::string& name : names) {
    const h5::Handle dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, "table " + name);
    const std::uint64_t finger = h5::readCountAttribute(dataset, "finger");
    if (finger >= names.size() || present[finger]) throw h5::Failure("the fingers are not numbered from 0");
    present[finger] = true;
    fingers[finger] = readRows<FingerRow>(dataset, columns);
  }
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
  for (std::size_t f = 0; f < fingers.size(); ++f) {
    const FingerRow& finger = fingers[f][row];
    state.fingers[f] = {Vec3(finger.p_WH), Vec3(finger.v_WH), finger.phase, finger.valid != 0};
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
}

/// Version 1 had no ticks that were made up without reaching the device.
Table scheduleTableOf(hid_t file) {
  Table table = scheduleTable();
  if (h5::readCountAttribute(file, "format_version") < 2)
    std::erase_if(table.columns, [](const Column& column) { return column.name == "made_up"; });
  return table;
}

void readTicks(hid_t file, const std::string& name, Recording& recording) {
  auto ticks = readTable<TickRow>(file, "haptic/ticks", tickTable());
  const auto fingers = readFingers(file);
  std::size_t count = commonPrefix(ticks, fingers);
  const Table schedule = scheduleTableOf(file);
  for (int g = 0; g < kRateGroupCount; ++g) {
    recording.schedule[static_cast<std::size_t>(g)] =
        readTable<ScheduleRow>(file, std::string("schedule/") + toString(static_cast<RateGroup>(g)), schedule);
  }
  auto& haptic = recording.schedule[static_cast<std::size_t>(RateGroup::kHaptic)];
  if (!haptic.empty()) {
    count = std::min(count, haptic.size());
    haptic.resize(count);
  }
  if (count == 0) refuse(607, name, "holds no tick", "the run ended before its first flush");
  for (std::size_t i = 0; i < count; ++i) {
    recording.time.push_back(ticks[i].time);
    recording.device.push_back(deviceState(ticks[i], fingers, i));
    recording.command.push_back(forceCommand(ticks[i], fingers, i));
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
