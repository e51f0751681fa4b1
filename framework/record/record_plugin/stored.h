#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/record/record_plugin/h5.h"
#include "framework/record/record_plugin/recording_file.h"

namespace presa::record {

/// Limits on values in a recording. A phase is chosen by the device; kMaxTicks is 24 days at 4 kHz.
inline constexpr std::int32_t kMaxPhases = 65536;
inline constexpr std::uint64_t kMaxTicks = std::uint64_t{1} << 33;

/// A table with the types and storage of this format: no links, filters, external or virtual storage, and every row is
/// stored in the file.
struct StoredTable {
  std::string path;  ///< "haptic/fingers/thumb"
  std::string name;  ///< "thumb"
  h5::Handle dataset;
  Table columns;                      ///< as in the file's format version
  std::uint64_t rows = 0;             ///< stored rows
  std::uint64_t place = 0;            ///< index of the finger among the roles, or of the body in the scene
  std::vector<std::string> phases{};  ///< of a finger, since format 9
};

/// A recording whose structure has been checked, before its rows are read.
struct StoredRecording {
  std::string name;  ///< file name
  h5::Handle file;
  std::uint64_t version = 0;  ///< format version
  std::string program_version, scene_file, scene_xml, rig_xml, start_utc;
  std::vector<std::string> faults;
  std::uint64_t seed = 0, dropped = 0;
  bool realtime = false, complete = false;
  double haptic_period = 0;  ///< [s]; NaN: attribute missing or invalid
  double force_share = 1;
  std::uint64_t scene_bodies = 0;
  StoredTable ticks;
  std::vector<StoredTable> fingers;     ///< in the order of the roles
  std::vector<StoredTable> bodies;      ///< in the order of the scene
  std::vector<StoredTable> tools;       ///< in the order of the roles; nothing before format 8
  std::vector<StoredTable> frames;      ///< in the order of the rig; nothing before format 10
  std::optional<StoredTable> orders{};  ///< nothing before format 11
  std::array<StoredTable, kScheduledGroupCount> schedule;
  std::optional<ScheduleInputs> inputs;  ///< of the schedule's rows; nothing before format 7
};

/// Checks the structure of a file against the schema: objects and their kinds, types, storage, attributes. Takes no
/// more memory than the file's length. Throws InputError: E603 to E606, E608, and, with all findings in `findings`,
/// E670 storage other than a recording's, E672 missing object or wrong type, E673 rows that are not stored. E671
/// (attributes) only goes to `findings`, because the rows can still be checked. Thread: holder of an h5::Library.
StoredRecording openStored(const std::string& file, Diagnostics& findings);

}  // namespace presa::record
