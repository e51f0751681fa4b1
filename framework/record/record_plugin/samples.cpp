#include "framework/record/record_plugin/samples.h"

#include "framework/record/record_plugin/contents.h"

namespace presa::record {
namespace {

double numberAt(const void* row, const Column& column) {
  switch (column.cell) {
    case Cell::kU64:
      return static_cast<double>(valueAt<std::uint64_t>(row, column.offset));
    case Cell::kI32:
      return valueAt<std::int32_t>(row, column.offset);
    case Cell::kU32:
      return valueAt<std::uint32_t>(row, column.offset);
    case Cell::kF64:
      break;
  }
  return valueAt<double>(row, column.offset);
}

/// All columns except index and time, which are the same in every table.
template <class Row>
RecordedTable byColumn(const StoredTable& table, const std::vector<Row>& rows) {
  RecordedTable result{table.name, {}, table.phases};
  for (const Column& column : table.columns.columns) {
    if (column.name == "index" || column.name == "time") continue;
    RecordedTable::Column one{column.name, column.unit, column.description, {}};
    one.values.reserve(rows.size());
    for (const Row& row : rows) one.values.push_back(numberAt(&row, column));
    result.columns.push_back(std::move(one));
  }
  return result;
}

void shorten(std::vector<RecordedTable>& tables, std::size_t count) {
  for (RecordedTable& table : tables) {
    for (RecordedTable::Column& column : table.columns) column.values.resize(count);
  }
}

}  // namespace

RecordedSamples readSamples(const std::string& file) {
  RecordedSamples samples;
  TakeRows take;
  take.finger = [&](const StoredTable& table, const std::vector<FingerRow>& rows) {
    samples.fingers.push_back(byColumn(table, rows));
  };
  take.body = [&](const StoredTable& table, const std::vector<BodyRow>& rows) {
    samples.bodies.push_back(byColumn(table, rows));
  };
  take.tool = [&](const StoredTable& table, const std::vector<ToolRow>& rows) {
    samples.tools.push_back(byColumn(table, rows));
  };
  take.frame = [&](const StoredTable& table, const std::vector<FrameRow>& rows) {
    samples.frames.push_back(byColumn(table, rows));
  };
  const Contents contents = readContents(file, take);
  samples.haptic_period = contents.stored.haptic_period;
  samples.complete = contents.stored.complete;
  samples.dropped = contents.stored.dropped;
  samples.scene_file = contents.stored.scene_file;
  samples.start_utc = contents.stored.start_utc;
  samples.faults = contents.stored.faults;
  samples.checksum = contents.checksum;
  samples.first_tick = contents.ticks.front().index;
  for (std::size_t i = 0; i < contents.count; ++i) {
    samples.time.push_back(contents.ticks[i].time);
    samples.status.push_back(contents.ticks[i].output_status);
  }
  shorten(samples.fingers, contents.count);
  shorten(samples.bodies, contents.count);
  shorten(samples.tools, contents.count);
  shorten(samples.frames, contents.count);
  return samples;
}

}  // namespace presa::record
