#include "tests/framework/record/mutation.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/record/record_plugin/reader.h"
#include "framework/record/record_plugin/recording_file.h"
#include "framework/record/record_plugin/samples.h"
#include "framework/record/record_plugin/stored.h"
#include "tests/framework/record/damage.h"

namespace presa::record {
namespace {

const char* const kTables[] = {"haptic/ticks",    "haptic/fingers/thumb", "haptic/fingers/index", "haptic/bodies/cube",
                               "schedule/haptic", "schedule/collision",   "schedule/dynamics",    "schedule/view"};
const char* const kPaths[] = {"/",        "haptic",    "haptic/fingers", "haptic/bodies",
                              "schedule", "scene_xml", "rig_xml",        "body_names"};
const char* const kAttributes[] = {"format",    "format_version", "complete", "dropped",         "program_version",
                                   "start_utc", "scene_file",     "seed",     "force_share",     "realtime",
                                   "sha256",    "finger",         "body",     "haptic_period_s", "fault_1",
                                   "fault_2",   "scene_name",     "columns",  "rate_haptic_hz",  "inputs"};
const char* const kColumns[] = {"index",     "time",      "device_count", "command_count",   "device_time",
                                "commanded", "rearms",    "phase",        "stop_requested",  "surfaces_changed",
                                "valid",     "mode",      "body",         "p_WH_x",          "f_command_W_z",
                                "made_up",   "version_0", "q_WB_w",       "commanded_value", "object_time_end"};
constexpr std::int64_t kWhole[] = {0,
                                   1,
                                   -1,
                                   2,
                                   3,
                                   4,
                                   7,
                                   8,
                                   9,
                                   10,
                                   97,
                                   1024,
                                   65535,
                                   65536,
                                   1'000'000,
                                   2147483647,
                                   -2,
                                   100,
                                   -2147483648LL,
                                   4294967295LL,
                                   8589934592LL,
                                   8589934593LL,
                                   std::numeric_limits<std::int64_t>::max(),
                                   std::numeric_limits<std::int64_t>::min()};
const double kReal[] = {0,
                        -0.0,
                        1,
                        -1,
                        1e-3,
                        1e-9,
                        0.01,
                        2.5e-5,
                        1e300,
                        -1e300,
                        5e-324,
                        std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity()};

class Words {
 public:
  Words(const std::uint8_t* bytes, std::size_t count) : bytes_(bytes), left_(count) {}
  bool empty() const { return left_ == 0; }
  std::uint8_t byte() {
    if (left_ == 0) return 0;
    --left_;
    return *bytes_++;
  }
  std::uint64_t number() {
    std::uint64_t value = 0;
    for (int i = 0; i < 8; ++i) value = value << 8 | byte();
    return value;
  }
  template <class Value, std::size_t kCount>
  Value of(const Value (&values)[kCount]) {
    return values[byte() % kCount];
  }
  std::int64_t whole() {
    const bool any = byte() % 4 == 0;
    return any ? static_cast<std::int64_t>(number()) : of(kWhole);
  }
  double real() {
    const bool any = byte() % 4 == 0;
    return any ? std::bit_cast<double>(number()) : of(kReal);
  }
  std::string text() {
    std::string text(byte() % 4 == 0 ? 60'000 : byte() % 40, 'x');
    for (std::size_t i = 0; i < std::min<std::size_t>(text.size(), 12); ++i) text[i] = static_cast<char>(byte());
    return text;
  }
  std::string object() { return byte() % 2 == 0 ? of(kTables) : of(kPaths); }

 private:
  const std::uint8_t* bytes_;
  std::size_t left_;
};

void mutateLinks(Damage& damage, Words& words) {
  const std::string path = words.object(), other = words.object();
  switch (words.byte() % 5) {
    case 0:
      return damage.dropLink(path);
    case 1:
      return damage.externalLink(path, "/dev/null", other);
    case 2:
      return damage.softLink(path, other);
    case 3:
      return damage.hardLink(path + "2", other);
    default:
      damage.dropLink(path);
      return damage.hardLink(path, other);
  }
}

void mutateStorage(Damage& damage, Words& words) {
  const std::string table = words.of(kTables);
  const std::uint64_t rows = static_cast<std::uint64_t>(words.whole());
  switch (words.byte() % 6) {
    case 0:
      return damage.virtualTable(table, "/dev/null", words.of(kTables));
    case 1:
      return damage.externallyStored(table, "/dev/null");
    case 2:
      return damage.filtered(table, words.byte() % 2 == 0 ? 1 + words.byte() % 6 : 32000);
    case 3:
      return damage.unallocated(table, rows);
    case 4:
      return damage.chunked(table, std::max<std::uint64_t>(1, rows % 2048));
    default:
      return damage.hugeText(words.byte() % 2 == 0 ? "scene_xml" : "rig_xml", std::max<std::uint64_t>(1, rows));
  }
}

void mutateOnce(Damage& damage, Words& words) {
  switch (words.byte() % 10) {
    case 0:
    case 1: {
      const std::string table = words.of(kTables), column = words.of(kColumns);
      return damage.cell(table, column, words.byte() % 64, words.whole());
    }
    case 2: {
      const std::string table = words.of(kTables), column = words.of(kColumns);
      return damage.cell(table, column, words.byte() % 64, words.real());
    }
    case 3: {
      const std::string table = words.of(kTables);
      // the rows are allocated, so their number is limited to protect the test's disk
      const std::uint64_t rows = static_cast<std::uint64_t>(words.whole()) % 20'000;
      // HDF5 visits every chunk that it drops, stored or not: a table that was made huge stays so
      if (damage.rowsOf(table) > 1'000'000) return;
      return damage.rows(table, rows);
    }
    case 4: {
      const std::string object = words.object(), name = words.of(kAttributes);
      return damage.attribute(object, name, static_cast<std::uint64_t>(words.whole()));
    }
    case 5: {
      const std::string object = words.object(), name = words.of(kAttributes);
      return damage.attribute(object, name, words.real());
    }
    case 6: {
      const std::string object = words.object(), name = words.of(kAttributes);
      return damage.attribute(object, name, words.text());
    }
    case 7:
      return mutateLinks(damage, words);
    case 8:
      return mutateStorage(damage, words);
    default: {
      const std::string object = words.object(), name = words.of(kAttributes);
      // half of the time declare an older format, without checksum, so that the mutation reaches the later checks
      if (words.byte() % 2 == 0) return damage.attribute("/", "format_version", std::uint64_t{1} + words.byte() % 7);
      return damage.dropAttribute(object, name);
    }
  }
}

std::string judgeRecording(const Recording& r, std::uint64_t specimen_ticks) {
  const std::size_t ticks = r.time.size();
  if (ticks == 0 || r.device.size() != ticks || r.command.size() != ticks || r.surfaces_changed.size() != ticks)
    return "lists of different length";
  for (std::size_t i = 0; i < ticks; ++i) {
    if (r.device[i].fingers.size() != r.fingers || r.command[i].f_H_W.size() != r.fingers)
      return "a tick with other fingers";
    if (!std::isfinite(r.time[i]) || (i > 0 && r.time[i] <= r.time[i - 1])) return "a time that does not rise";
    for (const FingerInput& finger : r.device[i].fingers)
      if (finger.phase < -1 || finger.phase >= kMaxPhases) return "a phase out of range";
  }
  for (const Recording::Command& command : r.commands)
    if (command.row >= ticks || command.slot >= 96) return "a command out of range";
  if (r.schedule.front().size() > ticks) return "a schedule for ticks that are not there";
  for (std::size_t g = 0; r.inputs && g < r.inputs->size(); ++g)
    if ((*r.inputs)[g].size() > ScheduleRow::kMaxBridges) return "more inputs than versions";
  if (!(r.haptic_period > 0) || !(r.force_share > 0 && r.force_share <= 1)) return "a setting out of range";
  if (r.checksum && (ticks != specimen_ticks || r.seed != 7 || (r.inputs && r.inputs->front().size() != 2) ||
                     r.command[0].f_H_W[0].x() != 0.5))
    return "another recording with a right checksum";
  return {};
}

std::string judgeSamples(const RecordedSamples& samples) {
  const std::size_t ticks = samples.time.size();
  if (ticks == 0 || samples.status.size() != ticks) return "columns of different length";
  for (const auto* tables : {&samples.fingers, &samples.bodies})
    for (const RecordedTable& table : *tables)
      for (const RecordedTable::Column& column : table.columns)
        if (column.values.size() != ticks) return "columns of different length";
  for (const RecordedTable& finger : samples.fingers)
    for (const double phase : finger.values("phase"))
      if (phase < -1 || phase >= kMaxPhases) return "a phase out of range";
  return {};
}

}  // namespace

void writeSpecimen(const std::string& file, std::uint64_t ticks) {
  World world;
  world.scene.bodies.resize(2);
  world.scene.bodies[0].name = "table";
  world.scene.bodies[0].fixed = true;
  world.scene.bodies[1].name = "cube";
  world.scene.devices.resize(2);
  world.scene.devices[0].role = "thumb";
  world.scene.devices[1].role = "index";
  world.scene.resolved_xml = "<scene/>";
  RunOptions options;
  options.seed = 7;
  options.record = file;
  options.overwrite = true;
  const h5::Library library;
  RecordingFile out(world, options, {});
  out.nameInputs({{{"contact_patches", "object_state"}, {}, {"contact_exchange"}, {}}});
  std::vector<std::uint64_t> words(out.layout().words());
  auto* const row = reinterpret_cast<std::byte*>(words.data());
  const auto put = [&](std::size_t offset, const auto& one) { std::memcpy(row + offset, &one, sizeof one); };
  for (std::uint64_t i = 0; i < ticks; ++i) {
    const double time = static_cast<double>(static_cast<std::int64_t>(i) * 1'000'000) * 1e-9;
    TickRow tick;
    tick.index = i;
    tick.time = tick.device_time = tick.command_time = tick.object_time_end = time;
    tick.device_count = tick.command_count = 2;
    put(0, tick);
    FingerRow finger;
    finger.index = i;
    finger.time = time;
    finger.f_command_W[0] = 0.5;
    finger.valid = 1;
    for (std::size_t f = 0; f < 2; ++f) put(out.layout().fingerOffset(f), finger);
    BodyRow body;
    body.index = i;
    body.time = time;
    put(out.layout().bodyOffset(0), body);
    out.append(words.data(), 1);
    ScheduleRow schedule;
    schedule.index = i;
    out.appendSchedule(RateGroup::kHaptic, &schedule, 1);
    schedule.index = i / 5;
    if (i % 5 == 0) out.appendSchedule(RateGroup::kDynamics, &schedule, 1);
  }
  out.finish();
}

void mutate(const std::string& file, const std::uint8_t* bytes, std::size_t count) {
  Damage damage(file);
  Words words(bytes, count);
  for (int i = 0; i < 12 && !words.empty(); ++i) {
    try {
      mutateOnce(damage, words);
    } catch (const h5::Failure&) {
      // an object removed by an earlier mutation cannot be changed
    }
  }
}

std::string judge(const std::string& file, std::uint64_t specimen_ticks, bool* accepted) {
  std::string wrong;
  bool taken = false;
  const auto look = [&](const auto& work) {
    try {
      const std::string problem = work();
      taken = true;
      if (wrong.empty()) wrong = problem;
    } catch (const InputError& error) {
      if (!error.diagnostics().hasErrors()) wrong = "a refusal without a reason";
    }
  };
  look([&] { return judgeRecording(readRecording(file), specimen_ticks); });
  look([&] { return judgeSamples(readSamples(file)); });
  if (accepted != nullptr) *accepted = taken;
  return wrong;
}

}  // namespace presa::record
