#pragma once
#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>
#include <cstdint>

#include "framework/core/exchange/latest_value.h"

namespace presa {

/// Queue of events in order, from one writer thread to one reader thread. Its memory is taken at
/// construction; when it is full, the writer drops the event and counts it instead of waiting.
template <PlainData T>
class EventRing {
 public:
  explicit EventRing(std::size_t capacity) : queue_(capacity) {}  ///< room for `capacity` events

  /// Writer: wait-free; false, and the event is counted as dropped, when the ring is full.
  bool push(const T& event) noexcept {
    if (queue_.push(event)) return true;
    dropped_.fetch_add(1, std::memory_order_relaxed);
    return false;
  }
  /// Reader: takes the oldest event; false when there is none.
  bool pop(T& event) noexcept { return queue_.pop(event); }

  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }  ///< refused; any thread

 private:
  boost::lockfree::spsc_queue<T> queue_;
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace presa
