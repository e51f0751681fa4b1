#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "framework/record/record_plugin/stored.h"
#include "framework/record/recording.h"

namespace presa::record {

/// The checked contents of a recording.
struct Contents {
  StoredRecording stored;
  std::size_t count = 0;  ///< ticks that every table has; rows beyond are ignored
  bool checksum = false;  ///< the file has a checksum and it matches
  std::vector<TickRow> ticks;
  std::array<std::vector<ScheduleRow>, kScheduledGroupCount> schedule;
};

/// Callbacks that receive the rows of fingers, bodies, tools, frames and orders, table by table, in order. Tables
/// without a callback are only
/// checked. Do not use the rows before readContents has returned: a later row may be refused.
struct TakeRows {
  std::function<void(const StoredTable&, std::vector<FingerRow>)> finger;
  std::function<void(const StoredTable&, std::vector<BodyRow>)> body;
  std::function<void(const StoredTable&, std::vector<ToolRow>)> tool;
  std::function<void(const StoredTable&, std::vector<FrameRow>)> frame;
  std::function<void(const StoredTable&, std::vector<OrderRow>)> order;
};

/// Reads and checks a file against its schema and its checksum. In a complete run all tables have the same ticks; in a
/// killed run they agree up to the last flush, where `count` ends. Throws InputError with every finding: E603 to E608
/// and E670 to E673 as openStored, E673 tables of different length, E674 index or time, E675 value of a row, E676
/// checksum.
Contents readContents(const std::string& file, const TakeRows& take);

}  // namespace presa::record
