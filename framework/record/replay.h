#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "framework/plan/load_world.h"
#include "framework/plan/session.h"
#include "framework/record/recording.h"

namespace presa {

/// Result of running a recording again.
struct ReplayResult {
  std::uint64_t ticks = 0;        ///< haptic ticks replayed
  std::uint64_t differing = 0;    ///< of these, with a commanded force that is not the same to the bit
  double first_difference = -1;   ///< time of the first [s]
  double largest_difference = 0;  ///< [N]
  std::string problem;            ///< why the replay could not go to the end; empty when it did
};

/// A recorded run once more, on this thread: the same scene, rig, seed and share of force, with the recorded samples for devices, and with
/// what experiments and commands changed on the way. It is on no bus. Thread: one.
class RecordedRun {
 public:
  /// `recording` outlives this. Findings of its scene go to `diagnostics`; with errors there is nothing to run. Throws InputError.
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
};

}  // namespace presa
