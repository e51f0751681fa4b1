#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/record/record_plugin/h5.h"
#include "framework/record/record_plugin/recording_file.h"

namespace presa::record {

/// Most that a recording may say. A phase is a number that a device gives its motion; a tick beyond this is 24 days at 4 kHz.
inline constexpr std::int32_t kMostPhases = 65536;
inline constexpr std::uint64_t kMostTicks = std::uint64_t{1} << 33;

/// A table whose type and storage are those of this format: no link, filter, other file or virtual dataset, and every row has its bytes
/// in the file.
struct StoredTable {
  std::string path;  ///< "haptic/fingers/thumb"
  std::string name;  ///< "thumb"
  h5::Handle dataset;
  Table columns;            ///< as this version of the format has them
  std::uint64_t rows = 0;   ///< that have their bytes in the file
  std::uint64_t place = 0;  ///< of a finger among the roles, of a body in the scene
};

/// A recording as it is stored, before a row of it is read.
struct StoredRecording {
  std::string name;  ///< of the file
  h5::Handle file;
  std::uint64_t version = 0;  ///< of the format
  std::string program_version, scene_file, scene_xml, rig_xml, start_utc;
  std::vector<std::string> faults;
  std::uint64_t seed = 0, dropped = 0;
  bool realtime = false, complete = false;
  double haptic_period = 0;  ///< NaN: it does not say
  double force_share = 1;
  std::uint64_t scene_bodies = 0;
  StoredTable ticks;
  std::vector<StoredTable> fingers;  ///< in the order of the roles
  std::vector<StoredTable> bodies;   ///< in the order of the scene
  std::array<StoredTable, kScheduledGroupCount> schedule;
};

/// Checks the structure of a file against the schema: which objects there are and of which kind, their types, where their bytes are, the
/// attributes. What is read takes no more memory than the file is long. Throws InputError: E603 to E606, E608, and, with every finding
/// of `findings`, E670 stored elsewhere or otherwise than a recording is, E672 a type or an object that is not there, E673 rows without
/// bytes. E671, an attribute, only goes to `findings`: the rows can be checked in spite of it. Thread: holder of the library.
StoredRecording openStored(const std::string& file, Diagnostics& findings);

}  // namespace presa::record
