#include "framework/record/record_plugin/stored.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "framework/core/diagnostics/refuse.h"
#include "framework/core/state/limits.h"
#include "framework/record/record_plugin/inspection.h"
#include "framework/record/record_plugin/open_file.h"

namespace presa::record {
namespace {

// range of the haptic period [s]: the schema's range of rates plus 10 %, because periods are rounded to nanoseconds
constexpr double kShortestPeriod = 0.9 / 40'000, kLongestPeriod = 1.1 / 100;
enum Code { kAttribute = 671 };
// allowance for a killed run [bytes]: its newest rows may be part of the tables' extents but not yet written (chunk
// caches, and HDF5's allocation steps)
constexpr std::uint64_t kUnwritten = std::uint64_t{64} << 20;

constexpr std::uint64_t kInputsSince = 7;
constexpr std::uint64_t kMaxFrames = 10'000;

bool isInName(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
}

/// The table as in an older format: without the columns that were added in version `since`.
Table asIn(std::uint64_t version, Table table, std::initializer_list<const char*> added, std::uint64_t since) {
  if (version >= since) return table;
  std::erase_if(table.columns, [&](const Column& column) {
    return std::any_of(added.begin(), added.end(), [&](const char* name) { return column.name == name; });
  });
  return table;
}

Table ticksOf(std::uint64_t version) {
  Table table = asIn(version, tickTable(), {"surfaces_changed"}, 3);
  return asIn(version, asIn(version, table, {"rearms"}, 4), {"commanded", "commanded_value"}, 5);
}

class Structure {
 public:
  Structure(StoredRecording& stored, std::uint64_t file_bytes, Diagnostics& findings)
      : stored_(stored), look_(stored.name, stored.file, file_bytes, findings) {}

  void check() {
    header();
    if (!stored_.complete) look_.allow(kUnwritten);
    if (look_.isGroup("haptic")) {
      table("haptic/ticks", ticksOf(stored_.version), stored_.ticks);
      group("haptic/fingers", "finger", fingerTable(), kMaxFingers, stored_.fingers);
      group("haptic/bodies", "body", bodyTable(), stored_.scene_bodies, stored_.bodies);
      if (stored_.version >= kToolsSince)
        group("haptic/tools", "tool", toolTable(), stored_.fingers.size(), stored_.tools);
      if (stored_.version >= kFramesSince) group("haptic/frames", "frame", frameTable(), kMaxFrames, stored_.frames);
      if (stored_.version >= kGuideSince) table("haptic/guide", orderTable(), stored_.orders.emplace());
    }
    if (!look_.isGroup("schedule")) return;
    if (stored_.version >= kInputsSince) stored_.inputs.emplace();
    for (std::size_t g = 0; g < stored_.schedule.size(); ++g) {
      const std::string path = std::string("schedule/") + toString(static_cast<RateGroup>(g));
      const bool sound = table(path, asIn(stored_.version, scheduleTable(), {"made_up"}, 2), stored_.schedule[g]);
      if (sound && stored_.inputs) (*stored_.inputs)[g] = inputs(path);
    }
  }

 private:
  void header() {
    constexpr std::uint64_t kAny = ~std::uint64_t{0};
    stored_.complete = look_.count("", "complete", 0, 1).value_or(0) != 0;
    stored_.realtime = look_.count("", "realtime", 0, 1).value_or(0) != 0;
    stored_.dropped = look_.count("", "dropped", 0, kAny).value_or(0);
    stored_.seed = look_.count("", "seed", 0, kAny).value_or(0);
    stored_.haptic_period = look_.real("", "haptic_period_s", kShortestPeriod, kLongestPeriod);
    // this attribute was added without a new format version
    if (h5::hasAttribute(stored_.file, "force_share"))
      stored_.force_share = look_.real("", "force_share", std::nextafter(0.0, 1.0), 1);
    stored_.program_version = look_.text("", "program_version");
    stored_.scene_file = look_.text("", "scene_file");
    stored_.start_utc = look_.text("", "start_utc");
    for (std::uint64_t i = 1; i <= RecordingFile::kMaxFaults; ++i) {
      const std::string name = "fault_" + std::to_string(i);
      if (!h5::hasAttribute(stored_.file, name)) break;
      stored_.faults.push_back(look_.text("", name));
    }
    stored_.scene_xml = look_.longText("scene_xml");
    stored_.rig_xml = look_.longText("rig_xml");
    stored_.scene_bodies = look_.textCount("body_names", kMaxBodies);
  }

  std::vector<std::string> phases(const std::string& path) {
    std::vector<std::string> names;
    std::istringstream lines(look_.text(path, kPhasesAttribute));
    for (std::string name; std::getline(lines, name);) names.push_back(std::move(name));
    return names;
  }

  /// Names of ports, as many as a row has versions at most, none twice.
  std::vector<std::string> inputs(const std::string& path) {
    std::vector<std::string> names;
    const auto wrong = [&](const std::string& what) {
      look_.wrong(kAttribute, path, std::string("attribute '") + kInputsAttribute + "': " + what);
      return std::vector<std::string>{};
    };
    std::istringstream words(look_.text(path, kInputsAttribute));
    for (std::string name; words >> name;) {
      const std::string place = "name " + std::to_string(names.size() + 1);
      if (!std::all_of(name.begin(), name.end(), isInName))
        return wrong(place + " is not the name of a port: letters, digits, '_', '-' and '.' are allowed");
      if (std::find(names.begin(), names.end(), name) != names.end())
        return wrong(place + ", '" + name + "', occurs twice; each name may occur once");
      names.push_back(std::move(name));
    }
    if (names.size() > ScheduleRow::kMaxBridges)
      return wrong("found " + std::to_string(names.size()) + " names, allowed up to " +
                   std::to_string(ScheduleRow::kMaxBridges));
    return names;
  }

  bool table(const std::string& path, const Table& columns, StoredTable& result) {
    auto found = look_.table(path, columns, !stored_.complete);
    if (!found) return false;
    result = {path, path.substr(path.rfind('/') + 1), std::move(found->dataset), columns, found->rows, 0};
    return true;
  }

  /// Reads the tables of a group, each with its own number below `max`.
  void group(const std::string& path, const std::string& number, const Table& columns, std::uint64_t max,
             std::vector<StoredTable>& tables) {
    if (!look_.isGroup(path)) return;
    const std::vector<std::string> names = look_.members(path);
    if (names.size() > max)
      return look_.wrong(672, path, "has " + std::to_string(names.size()) + " tables; at most " + std::to_string(max));
    bool numbered = true;
    for (const std::string& name : names) {
      StoredTable one;
      if (!table(path + '/' + name, columns, one)) continue;
      const auto place = look_.count(one.path, number, 0, max - 1);
      one.place = place.value_or(0);
      if (h5::hasAttribute(one.dataset, kPhasesAttribute)) one.phases = phases(one.path);
      numbered = numbered && place.has_value();
      tables.push_back(std::move(one));
    }
    std::sort(tables.begin(), tables.end(), [](const auto& a, const auto& b) { return a.place < b.place; });
    for (std::size_t i = 0; i < tables.size() && numbered; ++i) {
      // body numbers skip fixed bodies; those of fingers and frames must be consecutive
      const bool taken = i > 0 && tables[i].place == tables[i - 1].place;
      if (taken || ((number == "finger" || number == "frame") && names.size() == tables.size() && tables[i].place != i))
        look_.wrong(671, tables[i].path,
                    "attribute '" + number + "': found " + std::to_string(tables[i].place) +
                        (taken ? ", which is another table's" : "; they count from 0"));
    }
  }

  StoredRecording& stored_;
  Inspection look_;
};

}  // namespace

StoredRecording openStored(const std::string& file, Diagnostics& findings) {
  StoredRecording stored;
  stored.name = file;
  OpenedFile opened = openFile(file);
  stored.file = std::move(opened.handle);
  stored.version = opened.version;
  Structure(stored, opened.bytes, findings).check();
  const auto& all = findings.all();
  if (std::any_of(all.begin(), all.end(), [](const Diagnostic& one) { return one.code != kAttribute; }))
    throw InputError(findings);
  return stored;
}

}  // namespace presa::record
