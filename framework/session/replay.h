#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "framework/record/recording.h"
#include "framework/session/session.h"

namespace presa {

/// Result of running a recording again.
struct ReplayResult {
  std::uint64_t ticks = 0;        ///< haptic ticks replayed, each compared
  std::uint64_t recorded = 0;     ///< haptic ticks of the recording
  std::size_t fingers = 0;        ///< fingers per tick, each compared
  std::uint64_t differing = 0;    ///< ticks with a commanded force that is not the same to the bit
  double first_difference = -1;   ///< time of the first differing tick [s]
  double largest_difference = 0;  ///< [N]
  std::string problem;            ///< why the replay could not go to the end; empty when it did

  /// True if every commanded force of the recording was compared, there was at least one, and all are the same.
  bool verified() const { return problem.empty() && ticks == recorded && ticks > 0 && fingers > 0 && differing == 0; }
};

/// For each group and each of its inputs across rates: the column of the recorded schedule that holds its versions.
using ScheduleColumns = std::array<std::vector<std::size_t>, kScheduledGroupCount>;

/// Runs a recorded run again on the calling thread: the same scene, rig, seed and force share, with the recorded
/// samples in place of devices, and with the recorded changes of experiments and commands. It is on no bus. Thread:
/// one.
class RecordedRun {
 public:
  /// `recording` comes from RecordPlugin::read and outlives this. Findings of its scene go to `diagnostics`; E677 when
  /// scene and recording do not match; E678 when the recording does not hold the versions of an input. With errors,
  /// run() must not be called. Throws InputError.
  RecordedRun(const Recording& recording, Diagnostics& diagnostics);
  /// Replays every recorded tick of every rate group with exactly the recorded versions of its inputs, and compares the
  /// commanded forces bit by bit. Call once.
  ReplayResult run();
  /// Hash of the replayed states.
  std::uint64_t stateHash() const { return session_->monitor().hash(); }
  const Monitor& monitor() const { return session_->monitor(); }
  const std::shared_ptr<const World>& world() const { return session_->world(); }

 private:
  const Recording& recording_;
  RunControl control_;
  std::unique_ptr<Session> session_;
  ScheduleColumns columns_;
};

}  // namespace presa
