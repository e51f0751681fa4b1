#pragma once
#include <cstdint>

namespace presa {

/// Which ticks of a group that is late are made up (Tick::made_up). Made up after a stall they run at one instant, and only
/// the newest may leave for the world. A group that never gets up to date, because its ticks cost as much as its period,
/// still sends one a period: the force at a device must not hang until the stall is given up.
/// Thread: the group's; nonblocking.
class CatchUp {
 public:
  explicit CatchUp(std::int64_t period_ns) : period_(period_ns) {}

  /// Of the tick that begins at `now`, `late` after it was due [ns]. Once for each tick, in order.
  bool madeUp(std::int64_t now, std::int64_t late) noexcept {
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
  std::int64_t since_ = 0;  // when a tick was last sent, or the stall ended
  bool late_ = false;
};

}  // namespace presa
