#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/exchange/event_ring.h"
#include "framework/core/graph/module.h"
#include "framework/core/schedule/schedule_log.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/world.h"

namespace presa {

struct RecorderStatus {
  std::uint64_t rows = 0;     ///< haptic ticks on disk or on their way
  std::uint64_t dropped = 0;  ///< haptic ticks or schedule rows lost because the disk was too slow
  bool failed = false;        ///< the file could not be written (disk full)
};

/// Haptic-rate tap with its own writer thread. In ports: "device_state", "contact_exchange", "force_command",
/// "object_state" (optional). In real time step() only copies into a ring, and drops and counts a row that finds it
/// full. In lockstep, where no deadline exists, step() waits for the disk instead: nothing is ever dropped.
class Recorder : public Module {
 public:
  using Module::Module;
  /// The graph's schedule; before start().
  virtual void attach(ScheduleLog& schedule) = 0;
  /// Main thread: something went wrong in the run. A flight recorder writes its file now.
  virtual void fault(double time, const std::string& what) = 0;
  /// Flushes everything and closes the file; after the executor has stopped.
  virtual void finish() = 0;
  virtual RecorderStatus status() const noexcept = 0;
  /// Files that were written; after finish().
  virtual std::vector<std::string> files() const = 0;
};

/// A recording read back whole.
struct Recording {
  std::string file;        ///< that it was read from
  std::string scene_xml;   ///< resolved scene, as it ran
  std::string scene_file;  ///< name it had
  std::string rig_xml;
  std::string program_version;
  std::uint64_t seed = 0;
  bool realtime = false;
  bool complete = false;  ///< false: the run was killed; everything up to its last flush is here
  std::uint64_t dropped = 0;
  double force_share = 1;           ///< of the force limits that the run might use
  std::vector<std::string> faults;  ///< with their times, in words
  double haptic_period = 0;         ///< [s]
  bool checksum = false;            ///< it has one, and it is right; false: an older format, or the run was killed
  std::uint64_t first_tick = 0;     ///< not 0: it begins in the middle of a run, and cannot be run again
  std::uint64_t left_out = 0;       ///< ticks at the end of a killed run of which a part is missing
  std::size_t fingers = 0;          ///< of every tick
  std::size_t bodies = 0;           ///< of its scene, fixed ones too
  std::vector<double> time;         ///< one entry per haptic tick
  std::vector<DeviceState> device;
  std::vector<ForceCommand> command;
  std::vector<std::uint8_t> surfaces_changed;  ///< 1: they had their other friction
  /// What commands changed, in the order of ticks: entry of `time`, slot of SurfaceSettings, value.
  struct Command {
    std::size_t row, slot;
    double value;
  };
  std::vector<Command> commands;
  std::array<std::vector<ScheduleRow>, kScheduledGroupCount> schedule;
};

/// A table of a recording by column, one value per haptic tick. What the columns hold: README.md, or their own description.
struct RecordedTable {
  struct Column {
    std::string name, unit, description;
    std::vector<double> values;
  };
  std::string name;  ///< role of a finger, name of a body
  std::vector<Column> columns;
  /// Throws std::out_of_range when there is no such column.
  const std::vector<double>& values(const std::string& column) const;
};

/// What was felt and what moved, to be looked at: every table of the haptic ticks.
struct RecordedSamples {
  double haptic_period = 0;  ///< [s]
  bool complete = false;     ///< false: the run was killed; everything up to its last flush is here
  std::uint64_t dropped = 0;
  std::string scene_file;              ///< name it had
  std::string start_utc;               ///< of the run, or of the file of a fault
  std::vector<std::string> faults;     ///< with their times, in words
  bool checksum = false;               ///< it has one, and it is right; false: an older format, or the run was killed
  std::uint64_t first_tick = 0;        ///< not 0: it begins in the middle of a run, and cannot be run again
  std::vector<double> time;            ///< one entry per haptic tick
  std::vector<std::uint32_t> status;   ///< OutputStatus bits of all fingers together
  std::vector<RecordedTable> fingers;  ///< in the order of the scene's roles
  std::vector<RecordedTable> bodies;   ///< that can move, in the order of the scene
};

/// The record plug-in (HDF5), loaded when a run is recorded or replayed.
struct RecordPlugin {
  int abi;
  /// Creates the file world.options.record or, where that is empty, keeps the last two seconds for a fault, which writes them to
  /// world.options.flight. Throws InputError: E601 it exists (and options.overwrite is not set),
  /// E602 it cannot be written. Call it from an ordinary thread: the writer inherits priority and CPU set.
  std::unique_ptr<Recorder> (*create)(std::shared_ptr<const World> world);
  /// Checks the whole file before anything is made of it. Throws InputError with every finding: E603 cannot be read, E604 not HDF5,
  /// E605 not a recording, E606 newer format, E607 holds no tick, E608 damaged, E670 something is stored outside of the file or otherwise
  /// than a recording is, E671 an attribute, E672 an object or a column, E673 rows that are not stored, or tables of different length,
  /// E674 an index or a time, E675 a value of a row, E676 the checksum. The file of a killed run is read up to its last flush. What is
  /// read takes memory in proportion to the length of the file, whatever it says.
  Recording (*read)(const std::string& file);
  /// The same file by column, for people; throws the same.
  RecordedSamples (*samples)(const std::string& file);
};

}  // namespace presa
