#pragma once
#include <array>
#include <deque>
#include <memory>

#include "framework/record/record_plugin/recording_file.h"

namespace presa::record {

/// The last two seconds of a run, kept in memory; a fault writes them to a file of their own, with the half second that follows.
/// Another fault, later, goes to another file.
class FlightBuffer final : public RowSink {
 public:
  /// world.options.flight names the first file; NAME-2.h5 and so on follow, and none that exists is ever replaced. Throws
  /// InputError E602 when its folder cannot be written.
  explicit FlightBuffer(std::shared_ptr<const World> world);

  const RowLayout& layout() const noexcept override { return layout_; }
  void append(const std::uint64_t* rows, std::size_t count) override;
  void appendSchedule(RateGroup group, const ScheduleRow* rows, std::size_t count) override;
  void addFault(const std::string& what) override;
  void writeDropped(std::uint64_t dropped) override;
  void flush() override;
  std::uint64_t flushedTicks() const noexcept override { return file_ ? file_->flushedTicks() : 0; }
  void finish() override { close(); }
  void rollBack() noexcept override;
  std::vector<std::string> files() const override { return files_; }

  static constexpr double kBefore = 2.0, kAfter = 0.5;  ///< of a fault [s]

 private:
  void begin();
  void close();
  std::string nextName() const;

  std::shared_ptr<const World> world_;
  RowLayout layout_;
  std::size_t capacity_, after_;       // rows
  std::vector<std::uint64_t> kept_;    // a circle of `capacity_` rows
  std::size_t next_ = 0, filled_ = 0;  // rows
  std::array<std::deque<ScheduleRow>, kScheduledGroupCount> schedule_;
  std::unique_ptr<RecordingFile> file_;  // while a fault is being written
  std::size_t missing_ = 0;              // rows that it still wants
  std::uint64_t dropped_ = 0;
  std::vector<std::string> files_;
};

}  // namespace presa::record
