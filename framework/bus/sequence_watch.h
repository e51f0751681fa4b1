#pragma once
#include <cstdint>

namespace presa::bus {

/// Counts missing, duplicate and late sequence numbers of one key. Counting begins with the first number that is seen,
/// so a viewer that joins late has no loss. A number that arrives late is no longer missing.
///
/// A single number far from the others is ignored as a stray, since a forged or damaged one would make all genuine
/// numbers look old. When the next number follows the stray, both are accepted: this resumes counting after a long
/// suspension, and recovers after two consecutive forged numbers [RFC 3550, appendix A.1].
class SequenceWatch {
 public:
  enum class Arrival : std::uint8_t { kNewest, kLate, kDouble, kStray };
  static constexpr std::uint64_t kNear = 1024;  ///< maximum jump: five seconds of a run at 200 Hz

  Arrival see(std::uint64_t sequence) noexcept {
    if (highest_ == 0) first_ = highest_ = sequence - 1;
    if (isFar(sequence)) {
      const bool follows = stray_ != 0 && sequence == stray_ + 1;
      stray_ = sequence;
      if (!follows) return Arrival::kStray;
      goOnFrom(sequence);
      return Arrival::kNewest;
    }
    if (sequence > highest_) {
      const std::uint64_t ahead = sequence - highest_;
      seen_ = (ahead < kWindow ? seen_ << ahead : 0) | 1U;
      lost_ += ahead - 1;
      highest_ = sequence;
      ++received_;
      return Arrival::kNewest;
    }
    const std::uint64_t behind = highest_ - sequence;
    // beyond the window, or before the first number: treated as a duplicate
    if (sequence <= first_ || behind >= kWindow || (seen_ >> behind & 1U) != 0) return Arrival::kDouble;
    seen_ |= std::uint64_t{1} << behind;
    --lost_;
    ++received_;
    return Arrival::kLate;
  }

  bool any() const noexcept { return highest_ != 0; }
  std::uint64_t highest() const noexcept { return highest_; }
  std::uint64_t received() const noexcept { return received_; }
  /// Numbers missing between the first and the highest seen.
  std::uint64_t lost() const noexcept { return lost_; }
  /// Numbers missing up to `sent`, a number known to have been sent.
  std::uint64_t lostUpTo(std::uint64_t sent) const noexcept { return lost() + (sent > highest_ ? sent - highest_ : 0); }

 private:
  static constexpr std::uint64_t kWindow = 64;                // remembered numbers
  static constexpr std::uint64_t kLongestSilence = 1U << 24;  // a day at 200 Hz; a longer jump is not counted as loss

  bool isFar(std::uint64_t sequence) const noexcept {
    return sequence > highest_ ? sequence - highest_ > kNear : highest_ - sequence > kNear;
  }
  void goOnFrom(std::uint64_t sequence) noexcept {
    const bool missed = sequence > highest_ && sequence - highest_ <= kLongestSilence;
    if (missed)
      lost_ += sequence - highest_ - 1;
    else
      first_ = sequence - 1;
    seen_ = 1;
    highest_ = sequence;
    ++received_;
  }

  std::uint64_t first_ = 0;  // one below the first counted number
  std::uint64_t highest_ = 0, received_ = 0, lost_ = 0;
  std::uint64_t seen_ = 0;   // bit i: highest_ - i has arrived
  std::uint64_t stray_ = 0;  // last implausible number; 0: none
};

}  // namespace presa::bus
