#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "framework/core/math/random.h"
#include "framework/core/schedule/tick.h"
#include "framework/device/device.h"

namespace presa {

/// A group that wakes up late now and then, at random. The ticks that were due meanwhile run at once, or are skipped after
/// Executor::kCatchUpLimit, as in real time.
struct Jitter {
  double share = 0;  ///< of the times that it wakes up, 0 to 1
  int periods = 2;   ///< from the time before to a late one; 1: none is late
  bool operator==(const Jitter&) const = default;
};

/// What no scene describes: a machine that is late, and a line that delays.
struct Conditions {
  double latency = 0;   ///< from a command to its force on the finger; in whole haptic periods, rounded [s]
  Jitter haptic{0, 5};  ///< the lectures' (apps/studies/lectures)
  Jitter collision,
      dynamics;  ///< data older than max(20 ms, two periods) make the forces fade (framework/scene/ages.h)
  bool operator==(const Conditions&) const = default;
};

/// Draws at random which ticks are late, for LockstepExecutor::delay. Same seed: same ticks.
class LateTicks {
 public:
  LateTicks(const Conditions& conditions, std::uint64_t seed);
  /// Whether any tick can be late.
  bool any() const;
  /// Whether a tick that is due must wait.
  bool operator()(RateGroup group);

 private:
  struct Group {
    Jitter jitter;
    int waited = 0, period = 1;
  };
  std::array<Group, kRateGroupCount> groups_;
  RandomStream random_;
};

/// Values that arrive so many ticks after they were sent; `none` arrives before the first.
template <class Value>
class DelayLine {
 public:
  DelayLine(std::size_t ticks, const Value& none) : on_way_(ticks + 1, none) {}
  /// Sends the value of this tick; returns the one that arrives in it, valid until the next call.
  const Value& pass(const Value& sent) noexcept {
    on_way_[next_] = sent;
    next_ = (next_ + 1) % on_way_.size();
    return on_way_[next_];
  }

 private:
  std::vector<Value> on_way_;
  std::size_t next_ = 0;
};

/// The device behind a line that delays each command by so many haptic ticks.
std::unique_ptr<Device> behindLine(std::unique_ptr<Device> device, std::size_t ticks);

}  // namespace presa
