#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "framework/record/recording.h"
#include "framework/session/load_world.h"
#include "framework/session/session.h"

namespace presa {

/// Result of running a recording again.
struct ReplayResult {
  std::uint64_t ticks = 0;        ///< haptic ticks replayed, each compared
  std::uint64_t recorded = 0;     ///< haptic ticks of the recording
  std::size_t fingers = 0;        ///< of every tick, each compared
  std::uint64_t differing = 0;    ///< of these, with a commanded force that is not the same to the bit
  double first_difference = -1;   ///< time of the first [s]
  double largest_difference = 0;  ///< [N]
  std::string problem;            ///< why the replay could not go to the end; empty when it did

  /// Every commanded force of the recording was compared, there was one, and all are the same.
  bool verified() const { return problem.empty() && ticks == recorded && ticks > 0 && fingers > 0 && differing == 0; }
};

/// By group, for each of its inputs across rates: the column of a recording's schedule that holds its versions.
using ScheduleColumns = std::array<std::vector<std::size_t>, kScheduledGroupCount>;

/// A recorded run once more, on this thread: the same scene, rig, seed and share of force, with the recorded samples for devices, and with
/// what experiments and commands changed on the way. It is on no bus. Thread: one.
class RecordedRun {
 public:
  /// `recording`, as RecordPlugin::read gave it, outlives this. Findings of its scene go to `diagnostics`; E677 when scene
  /// and recording do not match; E678 when the recording does not say which version of an input was read. With errors
  /// there is nothing to run. Throws InputError.
  RecordedRun(const Recording& recording, Diagnostics& diagnostics);
  /// Every recorded tick of every rate group, each reading exactly the versions that it read then; compares the commanded forces bit by
  /// bit. Once.
  ReplayResult run();
  /// Of the states that came again.
  std::uint64_t stateHash() const { return session_->monitor().hash(); }
  const Monitor& monitor() const { return session_->monitor(); }
  const std::shared_ptr<const World>& world() const { return loaded_.world; }

 private:
  const Recording& recording_;
  RunControl control_;
  Loaded loaded_;
  std::unique_ptr<Session> session_;
  ScheduleColumns columns_;
};

}  // namespace presa
