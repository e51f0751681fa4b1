#include "framework/record/record_plugin/samples.h"

#include <algorithm>
#include <cstring>

#include "framework/diagnostics/refuse.h"
#include "framework/record/record_plugin/table_reader.h"

namespace presa::record {
namespace {

template <class Cell>
double cellAt(const void* row, std::size_t offset) {
  Cell value;
  std::memcpy(&value, static_cast<const char*>(row) + offset, sizeof value);
  return static_cast<double>(value);
}

double numberAt(const void* row, const Column& column) {
  switch (column.cell) {
    case Cell::kU64:
      return cellAt<std::uint64_t>(row, column.offset);
    case Cell::kI32:
      return cellAt<std::int32_t>(row, column.offset);
    case Cell::kU32:
      return cellAt<std::uint32_t>(row, column.offset);
    case Cell::kF64:
      break;
  }
  return cellAt<double>(row, column.offset);
}

/// Every column but the key of the rows, which are those of the ticks: `count` becomes the number that are.
template <class Row>
RecordedTable byColumn(const HapticTable& table, const Table& columns, const std::vector<TickRow>& ticks,
                       std::size_t& count) {
  const std::vector<Row> rows = readRows<Row>(table.dataset, columns);
  count = std::min(count, rows.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (rows[i].index != ticks[i].index) count = i;
  }
  RecordedTable result{table.name, {}};
  for (const Column& column : columns.columns) {
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

RecordedSamples readAll(hid_t file) {
  RecordedSamples samples;
  samples.haptic_period = h5::readRealAttribute(file, "haptic_period_s");
  samples.complete = h5::readCountAttribute(file, "complete") != 0;
  samples.dropped = h5::readCountAttribute(file, "dropped");
  samples.scene_file = h5::readStringAttribute(file, "scene_file");
  samples.start_utc = h5::readStringAttribute(file, "start_utc");
  samples.faults = readFaults(file);
  const auto ticks = readTable<TickRow>(file, "haptic/ticks", subset(tickTable(), {"index", "time", "output_status"}));
  std::size_t count = ticks.size();
  for (const HapticTable& table : hapticTables(file, "fingers", "finger"))
    samples.fingers.push_back(byColumn<FingerRow>(table, fingerTable(), ticks, count));
  for (const HapticTable& table : hapticTables(file, "bodies", "body"))
    samples.bodies.push_back(byColumn<BodyRow>(table, bodyTable(), ticks, count));
  for (std::size_t i = 0; i < count; ++i) {
    samples.time.push_back(ticks[i].time);
    samples.status.push_back(ticks[i].output_status);
  }
  if (count > 0) samples.first_tick = ticks.front().index;
  shorten(samples.fingers, count);
  shorten(samples.bodies, count);
  return samples;
}

}  // namespace

RecordedSamples readSamples(const std::string& file) {
  const h5::Library library;
  try {
    RecordedSamples samples = readAll(openRecording(file));
    if (samples.time.empty()) refuse(607, file, "holds no tick", "the run ended before its first flush");
    return samples;
  } catch (const h5::Failure& failure) {
    refuse(608, file, std::string("is damaged: ") + failure.what(), "was it copied completely?");
  }
}

}  // namespace presa::record
