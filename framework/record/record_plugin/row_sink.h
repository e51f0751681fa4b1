#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "framework/record/record_plugin/rows.h"
#include "framework/record/recording.h"

namespace presa::record {

/// Destination of the rows that a recorder's writer thread drains.
/// Thread: one at a time, holding an h5::Library. Throws h5::Failure.
class RowSink {
 public:
  virtual ~RowSink() = default;
  virtual const RowLayout& layout() const noexcept = 0;
  /// Whose versions the rows of the schedule hold; before the first of them.
  virtual void nameInputs(const ScheduleInputs& inputs) = 0;
  /// `count` rows of layout().bytes() each.
  virtual void append(const std::uint64_t* rows, std::size_t count) = 0;
  virtual void appendSchedule(RateGroup group, const ScheduleRow* rows, std::size_t count) = 0;
  /// Stores a fault of the run, a text with its time.
  virtual void addFault(const std::string& what) = 0;
  virtual void writeDropped(std::uint64_t dropped) = 0;
  virtual void flush() = 0;
  virtual std::uint64_t flushedTicks() const noexcept = 0;
  /// Marks the run as complete and closes.
  virtual void finish() = 0;
  /// After a Failure: discards unflushed data and closes, so that the flushed data stay readable.
  virtual void rollBack() noexcept = 0;
  /// Files that were written.
  virtual std::vector<std::string> files() const = 0;
};

/// The row layout for this world; `tools`: the roles whose devices measure their orientation.
RowLayout layoutOf(const World& world, const RecordedDevices& devices);

}  // namespace presa::record
