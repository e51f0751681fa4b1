#pragma once
#include <cstdint>

namespace presa::bus {

/// Counts what is missing, doubled and late in the numbers of one key. A viewer that joins late misses nothing: counting begins
/// with the first number that it sees. What arrives late after all is no longer missing.
class SequenceWatch {
 public:
  enum class Arrival : std::uint8_t { kNewest, kLate, kDouble };

  Arrival see(std::uint64_t sequence) noexcept {
    if (highest_ == 0) first_ = highest_ = sequence - 1;
    if (sequence > highest_) {
      const std::uint64_t ahead = sequence - highest_;
      seen_ = (ahead < kWindow ? seen_ << ahead : 0) | 1U;
      highest_ = sequence;
      ++received_;
      return Arrival::kNewest;
    }
    const std::uint64_t behind = highest_ - sequence;
    // longer ago than anybody remembers, or before the first: as good as double
    if (sequence <= first_ || behind >= kWindow || (seen_ >> behind & 1U) != 0) return Arrival::kDouble;
    seen_ |= std::uint64_t{1} << behind;
    ++received_;
    return Arrival::kLate;
  }

  bool any() const noexcept { return highest_ != 0; }
  std::uint64_t highest() const noexcept { return highest_; }
  std::uint64_t received() const noexcept { return received_; }
  /// Numbers missing between the first and the highest that were seen.
  std::uint64_t lost() const noexcept { return highest_ - first_ - received_; }
  /// The same up to a number that is known to have been sent.
  std::uint64_t lostUpTo(std::uint64_t sent) const noexcept { return lost() + (sent > highest_ ? sent - highest_ : 0); }

 private:
  static constexpr std::uint64_t kWindow = 64;  // numbers
  std::uint64_t first_ = 0;                     // one below the first that counts
  std::uint64_t highest_ = 0, received_ = 0;
  std::uint64_t seen_ = 0;  // bit i: highest_ - i has arrived
};

}  // namespace presa::bus
