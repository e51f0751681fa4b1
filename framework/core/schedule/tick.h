#pragma once
#include <cstdint>

namespace presa {

/// The groups of modules that run together, each at its own rate and, in real time, on its own thread.
enum class RateGroup : std::uint8_t { kHaptic, kCollision, kDynamics, kView, kBus };
inline constexpr int kRateGroupCount = 5;
const char* toString(RateGroup group) noexcept;

/// One step of a rate group. Time is simulated time, index * period exactly, in both executors; no module
/// reads a wall clock, so a recording can be replayed to the bit.
struct Tick {
  std::uint64_t index = 0;
  double time = 0;    ///< [s]
  double period = 0;  ///< [s]
  /// Run late, when a newer tick of its group was due already: state goes on, nothing leaves for the world outside, which
  /// would see all of them at one instant.
  bool made_up = false;
  /// The first after a gap: for longer than Executor::kGap no tick ran, and whatever was at the devices was held. The process stood
  /// still, or the whole machine slept.
  bool resumed = false;
};

}  // namespace presa
