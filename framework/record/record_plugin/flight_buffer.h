#pragma once
#include <array>
#include <deque>
#include <memory>

#include "framework/record/record_plugin/recording_file.h"

namespace presa::record {

/// Flight recorder: keeps the last two seconds of a run in memory. A fault writes them to a file, with the half second
/// that follows. A later fault goes to another file.
class FlightBuffer final : public RowSink {
 public:
  /// options.flight names the first file; further ones are NAME-2.h5 and so on. Existing files are never
  /// replaced. Throws InputError E602 when the folder is not writable.
  FlightBuffer(std::shared_ptr<const World> world, RunOptions options, RecordedDevices devices);

  const RowLayout& layout() const noexcept override { return layout_; }
  void nameInputs(const ScheduleInputs& inputs) override;
  void append(const std::uint64_t* rows, std::size_t count) override;
  void appendSchedule(RateGroup group, const ScheduleRow* rows, std::size_t count) override;
  void addFault(const std::string& what) override;
  void writeDropped(std::uint64_t dropped) override;
  void flush() override;
  std::uint64_t flushedTicks() const noexcept override { return file_ ? file_->flushedTicks() : 0; }
  void finish() override { close(); }
  void rollBack() noexcept override;
  std::vector<std::string> files() const override { return files_; }

  static constexpr double kBefore = 2.0, kAfter = 0.5;  ///< recorded time before and after a fault [s]

 private:
  void begin();
  void close();
  std::string nextName() const;

  std::shared_ptr<const World> world_;
  const RunOptions options_;
  const RecordedDevices devices_;
  RowLayout layout_;
  std::size_t capacity_, after_;       // rows
  std::vector<std::uint64_t> kept_;    // circular buffer of `capacity_` rows
  std::size_t next_ = 0, filled_ = 0;  // rows
  ScheduleInputs inputs_;
  std::array<std::deque<ScheduleRow>, kScheduledGroupCount> schedule_;
  std::unique_ptr<RecordingFile> file_;  // open while a fault is being written
  std::size_t missing_ = 0;              // rows still to be written to it
  std::uint64_t dropped_ = 0;
  std::vector<std::string> files_;
};

}  // namespace presa::record
