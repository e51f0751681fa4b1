#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/exchange/event_ring.h"
#include "framework/core/graph/module.h"
#include "framework/core/schedule/schedule_log.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/guide_orders.h"
#include "framework/scene/run_options.h"
#include "framework/scene/world.h"

namespace presa {

/// What a recording notes of a run's devices besides their values.
struct RecordedDevices {
  std::vector<std::size_t> tools;                ///< roles whose devices measure their orientation, in order
  std::vector<std::vector<std::string>> phases;  ///< Device::phases() of each role; may be shorter
  bool guided = false;                           ///< the guide of the assembly is in a viewer
  std::vector<std::string> frames{};             ///< names of the frames of the rig; empty: they are not in the run
};

struct RecorderStatus {
  std::uint64_t rows = 0;     ///< haptic ticks accepted: written or waiting to be written
  std::uint64_t dropped = 0;  ///< haptic ticks or schedule rows lost because the disk was too slow
  bool failed = false;        ///< the file could not be written, for example because the disk is full
};

/// Haptic-rate observer with its own writer thread. In ports: "device_state", "contact_exchange", "force_command",
/// "object_state" (all optional). In real time step() only copies a row into a ring; when the ring is full the row is
/// dropped and counted. In lockstep, without deadlines, step() waits for the disk: nothing is dropped.
class Recorder : public Module {
 public:
  using Module::Module;
  /// The schedule log of the executors, with its inputs set; call before start().
  virtual void attach(ScheduleLog& schedule) = 0;
  /// Main thread. Reports a fault at `time` [s]; a flight recorder then writes its file.
  virtual void fault(double time, const std::string& what) = 0;
  /// Flushes everything and closes the file; after the executor has stopped.
  virtual void finish() = 0;
  virtual RecorderStatus status() const noexcept = 0;
  /// Files written; valid after finish().
  virtual std::vector<std::string> files() const = 0;
};

/// A recording read back for replay.
struct Recording {
  std::string file;        ///< path it was read from
  std::string scene_xml;   ///< resolved scene
  std::string scene_file;  ///< original path of the scene
  std::string rig_xml;
  std::string program_version;
  std::uint64_t seed = 0;
  bool realtime = false;
  bool complete = false;  ///< false: the run was killed; the data end at its last flush
  std::uint64_t dropped = 0;
  double force_share = 1;           ///< fraction of the force limits that the run was allowed to use [-]
  std::vector<std::string> faults;  ///< texts with their times
  double haptic_period = 0;         ///< [s]
  bool checksum = false;            ///< present and correct; false: older format, or the run was killed
  std::uint64_t first_tick = 0;     ///< not 0: a flight recording, which starts in mid-run and cannot be replayed
  std::uint64_t left_out = 0;       ///< incomplete ticks at the end of a killed run, not included here
  std::size_t fingers = 0;          ///< number of fingers
  std::size_t bodies = 0;           ///< number of bodies in the scene, fixed ones included
  std::vector<double> time;         ///< one entry per haptic tick
  std::vector<DeviceState> device;
  std::vector<ForceCommand> command;
  std::vector<std::uint8_t> surfaces_changed;  ///< per tick; 1: surfaces had their changed friction
  /// A parameter change by command, in the order of ticks: index into `time`, slot of SurfaceSettings, value.
  struct Command {
    std::size_t row, slot;
    double value;
  };
  std::vector<Command> commands;
  bool guided = false;                     ///< the guide of the assembly was in a viewer
  std::vector<TakenOrders::Order> orders;  ///< its orders, in the order in which they were taken
  std::array<std::vector<ScheduleRow>, kScheduledGroupCount> schedule;
  /// The values whose versions the schedule holds. Absent in format 6 and older: then all that the group reads, in the
  /// alphabetical order of their names.
  std::optional<ScheduleInputs> inputs;
};

/// A table of a recording by column, one value per haptic tick. The columns are described in the file.
struct RecordedTable {
  struct Column {
    std::string name, unit, description;
    std::vector<double> values;
  };
  std::string name;  ///< role of the finger or name of the body
  std::vector<Column> columns;
  std::vector<std::string>
      phases{};  ///< of a finger: names of the phases that its column `phase` counts, from format 9
  /// Throws std::out_of_range when there is no such column.
  const std::vector<double>& values(const std::string& column) const;
};

/// A recording read back for analysis: every table of the haptic ticks.
struct RecordedSamples {
  double haptic_period = 0;  ///< [s]
  bool complete = false;     ///< false: the run was killed; the data end at its last flush
  std::uint64_t dropped = 0;
  std::string scene_file;              ///< original path of the scene
  std::string start_utc;               ///< start of the run, or time of the fault for a flight recording
  std::vector<std::string> faults;     ///< texts with their times
  bool checksum = false;               ///< present and correct; false: older format, or the run was killed
  std::uint64_t first_tick = 0;        ///< not 0: a flight recording, which starts in mid-run and cannot be replayed
  std::vector<double> time;            ///< one entry per haptic tick
  std::vector<std::uint32_t> status;   ///< OutputStatus bits of all fingers together
  std::vector<RecordedTable> fingers;  ///< in the order of the scene's roles
  std::vector<RecordedTable> bodies;   ///< free bodies, in the order of the scene
  std::vector<RecordedTable> tools;    ///< of roles whose device measures its orientation
  std::vector<RecordedTable> frames;   ///< of the rig; none before format 10
};

/// The record plug-in (HDF5), loaded when a run is recorded or replayed.
struct RecordPlugin {
  int abi;
  /// Creates the file options.record, or, when that is empty, keeps the last two seconds in memory; a fault then
  /// writes them to options.flight. Throws InputError: E601 the file exists (and options.overwrite is not set),
  /// E602 it cannot be written. Call from an ordinary thread, because the writer thread inherits its priority and CPU
  /// set.
  std::unique_ptr<Recorder> (*create)(std::shared_ptr<const World> world, const RunOptions& options,
                                      const RecordedDevices& devices);
  /// Checks the whole file before building anything from it. Throws InputError with every finding: E603 cannot be read,
  /// E604 not HDF5, E605 not a recording, E606 newer format, E607 no tick, E608 damaged, E670 storage other than a
  /// recording's, E671 attribute, E672 object or column, E673 rows not stored or tables of different length, E674 index
  /// or time, E675 value of a row, E676 checksum. The file of a killed run is read up to its last flush. Memory use is
  /// bounded by the length of the file, whatever the file claims.
  Recording (*read)(const std::string& file);
  /// Reads the same file by column, for analysis. Throws as read.
  RecordedSamples (*samples)(const std::string& file);
};

}  // namespace presa
