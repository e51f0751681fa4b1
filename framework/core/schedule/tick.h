#pragma once
#include <cstdint>

namespace presa {

/// Groups of modules that step together: each group has its own rate and, in real time, its own thread.
enum class RateGroup : std::uint8_t { kHaptic, kCollision, kDynamics, kView, kBus };
inline constexpr int kRateGroupCount = 5;        ///< values of RateGroup
const char* toString(RateGroup group) noexcept;  ///< "haptic", "collision", …; "?" for no group

/// One step of a rate group. Time is simulated time, exactly index * period in both executors. Modules take their
/// time from here and read no clock, so that a recording can be replayed to the bit.
struct Tick {
  std::uint64_t index = 0;  ///< from 0, counted by the group
  double time = 0;          ///< [s]
  double period = 0;        ///< [s]
  bool late = false;        ///< a newer tick of the group is already due: a module may leave out work that can wait
  /// Catch-up tick, a late one: modules advance their state but send nothing to the world outside, which would receive
  /// all of them at one instant. A group that is late for long still has one tick a period that is none.
  bool catch_up = false;
  /// First tick after a gap longer than Executor::kGap: the process was stopped or the machine was suspended, and the
  /// devices held their last forces meanwhile.
  bool resumed = false;
};

}  // namespace presa
