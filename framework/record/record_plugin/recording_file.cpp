#include "framework/record/record_plugin/recording_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>

#include "framework/core/diagnostics/refuse.h"
#include "framework/core/schedule/rates.h"
#include "framework/record/mesh_sums.h"
#include "framework/record/record_plugin/seal.h"

namespace presa::record {
namespace {

/// Checks that the file can be written and that no other data are lost; errors carry the system's reason.
void claim(const std::string& file, bool overwrite) {
  const int exclusive = overwrite ? 0 : O_EXCL;
  const int fd = open(file.c_str(), O_WRONLY | O_CREAT | O_NONBLOCK | O_CLOEXEC | exclusive, 0666);
  if (fd < 0 && errno == EEXIST) {
    refuse(601, "--record", "'" + file + "' exists already", "choose another name, or add --overwrite to replace it");
  }
  if (fd < 0)
    refuse(602, "--record", "'" + file + "' cannot be written: " + std::strerror(errno),
           "choose another name or folder");
  struct stat info {};
  const bool regular = fstat(fd, &info) == 0 && S_ISREG(info.st_mode);
  const bool busy = flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(fd);
  if (!regular) refuse(602, "--record", "'" + file + "' is not a regular file", "choose another name");
  if (busy) refuse(602, "--record", "'" + file + "' is being written by another run", "choose another name");
}

h5::Handle createFile(const std::string& name) {
  const h5::Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
  h5::check(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), "file access");
  // allocate file space in large steps: the end of file in the superblock, which a flush writes last, then almost
  // always covers the new chunks that the rest of the flush refers to
  h5::check(H5Pset_small_data_block_size(access, hsize_t{4} << 20), "file access");
  h5::check(H5Pset_meta_block_size(access, hsize_t{64} << 10), "file access");
  h5::check(H5Pset_file_locking(access, true, true), "file access");
  return {H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "file " + name};
}

std::string utcNow() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

/// Size of the attribute `inputs`: 12 names of 64 characters, separated by blanks, fit.
constexpr std::size_t kInputsBytes = 1024;

/// Longest attribute of names [byte]; HDF5 has room for 64 kB.
constexpr std::size_t kPhasesBytes = 60'000;

/// Each name on a line of its own; none at all when they are too long.
std::string lines(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += name + '\n';
  return text.size() <= kPhasesBytes ? text : std::string();
}

/// A name as an HDF5 link name: '/' would start a sub-group.
std::string linkName(std::string name) {
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

}  // namespace

Table scheduleTable() {
  Table table{sizeof(ScheduleRow), {}};
  table.columns.push_back({"index", offsetof(ScheduleRow, index), Cell::kU64, "1", "number of the group's tick"});
  table.columns.push_back(
      {"made_up", offsetof(ScheduleRow, catch_up), Cell::kU64, "1",
       "sum of 1: not sent to the device, as a newer tick was due; 2: the first after a gap; 4: run late"});
  for (std::size_t i = 0; i < ScheduleRow::kMaxBridges; ++i) {
    table.columns.push_back(
        {"version_" + std::to_string(i), offsetof(ScheduleRow, versions) + i * sizeof(std::uint64_t), Cell::kU64, "1",
         "version read of the value that 'inputs' names at place " + std::to_string(i) + " (from 0); 0: none"});
  }
  return table;
}

RowLayout layoutOf(const World& world, const RecordedDevices& devices) {
  RowLayout layout;
  layout.fingers = world.scene.devices.size();
  layout.bodies = static_cast<std::size_t>(std::count_if(world.scene.bodies.begin(), world.scene.bodies.end(),
                                                         [](const Body& body) { return !body.fixed; }));
  layout.tools = devices.tools;
  layout.frames = devices.frames.size();
  layout.orders = devices.guided;
  return layout;
}

RecordingFile::RecordingFile(const World& world, const RunOptions& options, const RecordedDevices& devices)
    : name_(options.record), layout_(layoutOf(world, devices)) {
  const std::string& name = name_;
  claim(name, options.overwrite);
  try {
    create(world, options, devices);
    flush();
  } catch (const h5::Failure& failure) {
    file_.reset();
    std::error_code ignored;
    std::filesystem::remove(name, ignored);  // it has no content yet
    refuse(602, "--record", "'" + name + "' cannot be written: " + failure.what(),
           "make room, or choose another folder");
  }
}

void RecordingFile::create(const World& world, const RunOptions& options, const RecordedDevices& devices) {
  std::uint64_t version = layout_.tools.empty() ? kToolsSince - 1 : kToolsSince;
  file_ = createFile(options.record);
  for (const char* group : {"haptic", "haptic/fingers", "haptic/bodies", "schedule"}) h5::group(file_, group);
  tables_.push_back(createTable("haptic", "ticks", tickTable()));
  for (std::size_t f = 0; f < layout_.fingers; ++f) {
    tables_.push_back(createTable("haptic/fingers", linkName(world.scene.devices[f].role), fingerTable()));
    h5::writeAttribute(tables_.back().dataset, "finger", std::uint64_t{f});
    h5::writeAttribute(tables_.back().dataset, "fingertip_radius_m", world.scene.devices[f].fingertip_radius);
    const std::string phases = f < devices.phases.size() ? lines(devices.phases[f]) : std::string();
    if (phases.empty()) continue;
    h5::writeAttribute(tables_.back().dataset, kPhasesAttribute, phases);
    version = kPhasesSince;
  }
  for (std::size_t b = 0; b < world.scene.bodies.size(); ++b) {
    if (world.scene.bodies[b].fixed) continue;
    tables_.push_back(createTable("haptic/bodies", linkName(world.scene.bodies[b].name), bodyTable()));
    h5::writeAttribute(tables_.back().dataset, "body", std::uint64_t{b});
  }
  if (layout_.frames > 0) version = kFramesSince;
  if (layout_.orders) version = kGuideSince;
  if (version >= kToolsSince) h5::group(file_, "haptic/tools");
  for (const std::size_t f : layout_.tools) {
    tables_.push_back(createTable("haptic/tools", linkName(world.scene.devices[f].role), toolTable()));
    h5::writeAttribute(tables_.back().dataset, "tool", std::uint64_t{f});
  }
  if (version >= kFramesSince) h5::group(file_, "haptic/frames");
  for (std::size_t n = 0; n < layout_.frames; ++n) {
    tables_.push_back(createTable("haptic/frames", linkName(devices.frames[n]), frameTable()));
    h5::writeAttribute(tables_.back().dataset, "frame", std::uint64_t{n});
  }
  if (layout_.orders) tables_.push_back(createTable("haptic", "guide", orderTable()));
  for (int g = 0; g < kScheduledGroupCount; ++g) {
    schedule_.push_back(createTable("schedule", toString(static_cast<RateGroup>(g)), scheduleTable()));
    // with room for the names, so that they change no place in the file when they come
    h5::writeAttribute(schedule_.back().dataset, kInputsAttribute, std::string(kInputsBytes, '\0'));
  }
  describe(world, options, version);
}

void RecordingFile::describe(const World& world, const RunOptions& options, std::uint64_t version) {
  const RateTable rates(world.scene.rates);
  h5::writeAttribute(file_, "format", std::string(kFormatName));
  h5::writeAttribute(file_, "format_version", version);
  h5::writeAttribute(file_, "complete", std::uint64_t{0});
  h5::writeAttribute(file_, seal::kAttribute, seal::open());
  h5::writeAttribute(file_, "dropped", std::uint64_t{0});
  h5::writeAttribute(file_, "program_version", std::string(PRESA_VERSION));
  h5::writeAttribute(file_, "start_utc", utcNow());
  h5::writeAttribute(file_, "scene_name", world.scene.name);
  h5::writeAttribute(file_, "scene_file", world.scene.file);
  h5::writeAttribute(file_, "rig_file", world.rig.file);
  h5::writeAttribute(file_, "seed", options.seed);
  h5::writeAttribute(file_, "force_share", options.force_share);
  h5::writeAttribute(file_, "realtime", std::uint64_t{options.realtime});
  h5::writeAttribute(file_, "haptic_period_s", rates.period(RateGroup::kHaptic));
  for (int g = 0; g < kScheduledGroupCount; ++g) {
    const auto group = static_cast<RateGroup>(g);
    h5::writeAttribute(file_, std::string("rate_") + toString(group) + "_hz", rates.rate(group));
  }
  if (const std::string sums = meshSumsOf(world.scene); !sums.empty())
    h5::writeAttribute(file_, kMeshSumsAttribute, sums);
  h5::writeText(file_, "scene_xml", world.scene.resolved_xml);
  h5::writeText(file_, "rig_xml", world.rig.resolved_xml);
  std::vector<std::string> names;
  for (const Body& body : world.scene.bodies) names.push_back(body.name);
  h5::writeTexts(file_, "body_names", names);
}

RecordingFile::TableFile RecordingFile::createTable(const std::string& group, const std::string& name,
                                                    const Table& table) {
  const hsize_t none = 0, chunk = kBlockRows, unlimited = H5S_UNLIMITED;
  const h5::Handle space(H5Screate_simple(1, &none, &unlimited), H5Sclose, "table space");
  const h5::Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "table properties");
  h5::check(H5Pset_chunk(properties, 1, &chunk), "table properties");
  // allocate space when a table grows, not at the flush: see reserve()
  h5::check(H5Pset_alloc_time(properties, H5D_ALLOC_TIME_EARLY), "table properties");
  h5::check(H5Pset_obj_track_times(properties, false), "table properties");
  const h5::Handle file_type = h5::compoundType(table, h5::Side::kFile);
  TableFile result;
  result.path = group + '/' + name;
  result.dataset =
      h5::Handle(H5Dcreate2(file_, result.path.c_str(), file_type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
                 H5Dclose, "table " + name);
  result.memory_type = h5::compoundType(table, h5::Side::kMemory);
  result.row_bytes = table.row_bytes;

  std::vector<std::string> names, units, descriptions;
  for (const Column& column : table.columns) {
    names.push_back(column.name);
    units.push_back(column.unit);
    descriptions.push_back(column.description);
  }
  h5::writeAttribute(result.dataset, "columns", names);
  h5::writeAttribute(result.dataset, "units", units);
  h5::writeAttribute(result.dataset, "descriptions", descriptions);
  h5::writeAttribute(result.dataset, seal::kAttribute, seal::open());
  return result;
}

void RecordingFile::appendTo(TableFile& table, const void* rows, std::size_t count) {
  const hsize_t begin = table.rows, length = count, end = begin + length;
  h5::check(H5Dset_extent(table.dataset, &end), "table length");
  const h5::Handle file_space(H5Dget_space(table.dataset), H5Sclose, "table space");
  h5::check(H5Sselect_hyperslab(file_space, H5S_SELECT_SET, &begin, nullptr, &length, nullptr), "table selection");
  const h5::Handle memory_space(H5Screate_simple(1, &length, nullptr), H5Sclose, "row space");
  h5::check(H5Dwrite(table.dataset, table.memory_type, memory_space, file_space, H5P_DEFAULT, rows), "rows");
  table.rows = end;
  table.sum.add(rows, count * table.row_bytes);
}

void RecordingFile::nameInputs(const ScheduleInputs& inputs) {
  for (std::size_t g = 0; g < inputs.size(); ++g) {
    std::string names;
    for (const std::string& name : inputs[g]) names += (names.empty() ? "" : " ") + name;
    if (names.size() > kInputsBytes) throw h5::Failure("names of inputs are too long: " + names);
    h5::writeAttribute(schedule_[g].dataset, kInputsAttribute, names);
  }
}

void RecordingFile::append(const std::uint64_t* rows, std::size_t count) {
  const auto* bytes = reinterpret_cast<const std::byte*>(rows);
  std::size_t offset = 0;
  for (TableFile& table : tables_) {
    gathered_.resize(count * table.row_bytes);
    for (std::size_t i = 0; i < count; ++i) {
      std::memcpy(&gathered_[i * table.row_bytes], bytes + i * layout_.bytes() + offset, table.row_bytes);
    }
    appendTo(table, gathered_.data(), count);
    offset += table.row_bytes;
  }
}

void RecordingFile::appendSchedule(RateGroup group, const ScheduleRow* rows, std::size_t count) {
  appendTo(schedule_[static_cast<std::size_t>(group)], rows, count);
}

void RecordingFile::addFault(const std::string& what) {
  if (++faults_ <= kMaxFaults) h5::writeAttribute(file_, "fault_" + std::to_string(faults_), what);
}

void RecordingFile::writeDropped(std::uint64_t dropped) { h5::writeAttribute(file_, "dropped", dropped); }

void RecordingFile::reserve() {
  hsize_t size = 0;
  void* handle = nullptr;
  h5::check(H5Fget_filesize(file_, &size), "file size");
  if (size <= reserved_) return;
  h5::check(H5Fget_vfd_handle(file_, H5P_DEFAULT, &handle), "file descriptor");
  rlimit limit{};
  if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && size > limit.rlim_cur) throw h5::Failure(std::strerror(EFBIG));
  // reserve space only; the length of the file is managed by HDF5
  const int fd = *static_cast<const int*>(handle);
  while (fallocate(fd, FALLOC_FL_KEEP_SIZE, static_cast<off_t>(reserved_), static_cast<off_t>(size - reserved_)) != 0) {
    if (errno == EOPNOTSUPP) break;  // this file system cannot reserve space
    if (errno != EINTR) throw h5::Failure(std::strerror(errno));
  }
  reserved_ = size;
}

void RecordingFile::flush() {
  reserve();
  h5::check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "flush");
  for (TableFile& table : tables_) table.flushed = table.rows;
  for (TableFile& table : schedule_) table.flushed = table.rows;
}

void RecordingFile::close() {
  tables_.erase(tables_.begin() + 1, tables_.end());  // keep the first one: flushedTicks() needs its row count
  schedule_.clear();
  tables_.front().dataset.reset();
  tables_.front().memory_type.reset();
  if (!file_.reset()) throw h5::Failure("close");
}

void RecordingFile::seal() {
  std::vector<seal::TableSum> sums;
  const auto close = [&](TableFile& table) {
    sums.push_back({table.path, table.rows, table.sum.finish()});
    h5::writeAttribute(table.dataset, seal::kAttribute, sums.back().sha256);
  };
  std::for_each(tables_.begin(), tables_.end(), close);
  std::for_each(schedule_.begin(), schedule_.end(), close);
  h5::writeAttribute(file_, seal::kAttribute, seal::sumOf(file_, std::move(sums)));
}

void RecordingFile::finish() {
  seal();
  flush();
  h5::writeAttribute(file_, "complete", std::uint64_t{1});  // last, when everything else has been written
  close();
}

void RecordingFile::rollBack() noexcept {
  const auto shorten = [](TableFile& table) { H5Dset_extent(table.dataset, &table.flushed); };
  std::for_each(tables_.begin(), tables_.end(), shorten);
  std::for_each(schedule_.begin(), schedule_.end(), shorten);
  try {
    close();
  } catch (const h5::Failure&) {
    // the disk refuses even this; the data of earlier flushes are already stored
  }
}

}  // namespace presa::record
