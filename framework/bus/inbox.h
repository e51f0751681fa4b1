#pragma once
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <variant>
#include <vector>

#include "framework/bus/state_bus.h"

namespace presa::bus {

/// Queue of received samples for one reader. Any thread may put, one takes; they share a lock, so neither may be the
/// haptic thread.
class Inbox {
 public:
  using Item = std::variant<ObjectSample, FingerSample, FrameSample, Heartbeat, Event, RunInfo>;

  /// When `capacity` samples are waiting, new ones are discarded and counted in overrun().
  explicit Inbox(std::size_t capacity) : capacity_(capacity) {}
  void put(const Item& item, std::int64_t received_ns);
  void take(Listener& listener);
  void wait(double seconds);
  std::uint64_t overrun() const;

 private:
  struct Received {
    Item item;
    std::int64_t at_ns;
  };
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<Received> items_;
  std::vector<Received> taken_;  // reader's buffer, swapped with items_ to keep the memory
  std::uint64_t overrun_ = 0;
};

}  // namespace presa::bus
