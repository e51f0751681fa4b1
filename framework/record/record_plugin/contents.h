#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "framework/record/record_plugin/stored.h"
#include "framework/record/recording.h"

namespace presa::record {

/// Everything that a recording says, checked as a whole.
struct Contents {
  StoredRecording stored;
  std::size_t count = 0;  ///< ticks that every table has; rows beyond belong to none
  bool checksum = false;  ///< there is one, and it is right
  std::vector<TickRow> ticks;
  std::array<std::vector<ScheduleRow>, kScheduledGroupCount> schedule;
};

/// Who takes the rows of fingers and bodies, table by table, in order; what is not asked for is checked only. Nothing of it is to be
/// used before readContents has returned: the next row may be one that is refused.
struct TakeRows {
  std::function<void(const StoredTable&, std::vector<FingerRow>)> finger;
  std::function<void(const StoredTable&, std::vector<BodyRow>)> body;
};

/// Reads and checks a file against its schema, and its checksum. The tables of a run that ended in order have the same ticks; those of a
/// killed one agree up to its last flush, and `count` ends there. Throws InputError with every finding: E603 to E608, E670 to E673 as
/// openStored, E673 tables of different length, E674 an index or a time, E675 a value of a row, E676 the checksum.
Contents readContents(const std::string& file, const TakeRows& take);

}  // namespace presa::record
