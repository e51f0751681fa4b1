#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "framework/record/checksum/checksum.h"
#include "framework/record/record_plugin/h5.h"
#include "framework/record/record_plugin/row_sink.h"
#include "framework/record/recording.h"
#include "framework/scene/run_options.h"
#include "framework/scene/world.h"

namespace presa::record {

/// Version of the file layout; a reader refuses a higher one. A file without what a
/// version added has the version before.
inline constexpr std::uint64_t kFormatVersion =
    11;  // 2: made_up in the schedule; 3: surfaces_changed, 4: rearms, 5: commanded in the ticks; 6: sha256; 7: inputs; 8: tools; 9: phases; 10: frames; 11: guide
/// First version with haptic/tools.
inline constexpr std::uint64_t kToolsSince = 8;
/// Attribute of a finger's table, since format 9: the names of its phases, one a line.
inline constexpr const char* kPhasesAttribute = "phases";
inline constexpr std::uint64_t kPhasesSince = 9;
/// First version with haptic/frames.
inline constexpr std::uint64_t kFramesSince = 10;
/// First version with haptic/guide, of a run whose guide was in a viewer.
inline constexpr std::uint64_t kGuideSince = 11;
inline constexpr const char* kFormatName = "presa-recording";
/// Rows per chunk of the file and per write.
inline constexpr std::size_t kBlockRows = 1024;

Table scheduleTable();
/// Attribute of a schedule table, since format 7: the names of ScheduleInputs, separated by blanks.
inline constexpr const char* kInputsAttribute = "inputs";
inline constexpr const char* kMeshSumsAttribute = "mesh_sums";  ///< of the root, where the scene names meshes

/// A recording being written: tables of named columns that only grow and are flushed together. After a kill at any
/// moment the file is readable up to its last flush. For this reason nothing is compressed (a compressed chunk moves
/// when it grows) and the library bounds are the default ones (newer ones mark the file as open). See README.md.
/// Thread: one at a time, holding an h5::Library. Throws h5::Failure.
class RecordingFile final : public RowSink {
 public:
  /// Throws InputError E601, E602.
  RecordingFile(const World& world, const RunOptions& options, const RecordedDevices& devices);

  const RowLayout& layout() const noexcept override { return layout_; }
  void nameInputs(const ScheduleInputs& inputs) override;
  void append(const std::uint64_t* rows, std::size_t count) override;
  void appendSchedule(RateGroup group, const ScheduleRow* rows, std::size_t count) override;
  void addFault(const std::string& what) override;
  void writeDropped(std::uint64_t dropped) override;
  void flush() override;
  std::uint64_t flushedTicks() const noexcept override { return tables_.front().flushed; }
  void finish() override;
  void rollBack() noexcept override;
  std::vector<std::string> files() const override { return {name_}; }

  static constexpr std::uint64_t kMaxFaults = 1000;  ///< stored per file

 private:
  struct TableFile {
    h5::Handle dataset;
    h5::Handle memory_type;
    std::size_t row_bytes = 0;
    hsize_t rows = 0;
    hsize_t flushed = 0;
    std::string path;
    Sha256 sum;  ///< of all rows
  };
  void create(const World& world, const RunOptions& options, const RecordedDevices& devices);
  void describe(const World& world, const RunOptions& options, std::uint64_t version);
  TableFile createTable(const std::string& group, const std::string& name, const Table& table);
  static void appendTo(TableFile& table, const void* rows, std::size_t count);
  /// Reserves disk space for the next flush, so that a full disk is detected before the flush, not half-way through it.
  void reserve();
  /// Writes the checksums; only after all rows have been added.
  void seal();
  void close();

  std::string name_;
  RowLayout layout_;
  std::uint64_t faults_ = 0;
  h5::Handle file_;
  std::vector<TableFile>
      tables_;  ///< as RowLayout: the ticks, each finger, each free body, each tool, each frame, the guide
  std::vector<TableFile> schedule_;  ///< by RateGroup
  std::vector<std::byte> gathered_;
  hsize_t reserved_ = 0;  ///< bytes of the file with reserved space
};

}  // namespace presa::record
