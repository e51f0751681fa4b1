#pragma once
#include <cstdint>

namespace presa {

/// Decides which ticks of a late group are catch-up ticks (Tick::catch_up). After a stall the missed ticks run at one
/// instant, and only the newest may write to the world outside. A group that never catches up, because its ticks take
/// as long as its period, still writes once per period: the force at a device must not freeze meanwhile.
/// Thread: the group's; nonblocking.
class CatchUp {
 public:
  explicit CatchUp(std::int64_t period_ns) : period_(period_ns) {}  ///< period of the group [ns]

  /// Whether the tick that begins at `now`, `late` after it was due [ns], is a catch-up tick. Call once per tick.
  bool isCatchUp(std::int64_t now, std::int64_t late) noexcept {
    const bool newest = late < period_, begins = !newest && !late_;
    late_ = !newest;
    if (!newest && (begins || now - since_ < period_)) {
      if (begins) since_ = now;
      return true;
    }
    since_ = now;
    return false;
  }

 private:
  std::int64_t period_;
  std::int64_t since_ = 0;  // last tick that was no catch-up tick, or begin of the delay [ns]
  bool late_ = false;
};

}  // namespace presa
