#pragma once
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace presa::record {

/// Lock-free ring of rows between one writer and one reader thread: an EventRing whose element size is fixed at
/// construction, because it depends on the scene. A row becomes visible as a whole or not at all.
class RowRing {
 public:
  RowRing(std::size_t words_per_row, std::size_t rows) : words_(words_per_row), queue_(words_per_row * rows) {
    // touch every page now, so that no tick causes a page fault
    const std::vector<std::uint64_t> zero(words_, 0);
    while (push(zero)) {
    }
    queue_.consume_all([](std::uint64_t) {});
  }

  /// Writer. Wait-free; false when full.
  bool push(std::span<const std::uint64_t> row) noexcept {
    if (queue_.write_available() < words_) return false;
    queue_.push(row.data(), words_);
    return true;
  }
  bool full() const noexcept { return queue_.write_available() < words_; }
  /// Writer. True when more than half of the ring is unread.
  bool crowded() const noexcept { return crowded_below_ > queue_.write_available(); }

  /// Reader. Takes up to `max_rows` of the oldest rows and returns their number.
  std::size_t pop(std::uint64_t* rows, std::size_t max_rows) noexcept {
    return queue_.pop(rows, max_rows * words_) / words_;
  }

 private:
  std::size_t words_;
  boost::lockfree::spsc_queue<std::uint64_t> queue_;
  std::size_t crowded_below_ = queue_.write_available() / 2;
};

}  // namespace presa::record
