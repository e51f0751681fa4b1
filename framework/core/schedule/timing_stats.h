#pragma once
#include <array>
#include <atomic>
#include <cstdint>

namespace presa {

/// Histogram of durations in fixed memory: 32 buckets per octave of nanoseconds (error below 2.2 %), exact
/// maximum. One writer; exact when read after the run, approximate when read live.
class DurationHistogram {
 public:
  void add(std::int64_t nanoseconds) noexcept;             ///< negative: counts as 0
  std::uint64_t count() const noexcept { return count_; }  ///< samples
  std::int64_t max() const noexcept { return max_; }       ///< exact [ns]; 0 when empty
  /// Of all samples [ns]; 0 when empty.
  double mean() const noexcept { return count_ == 0 ? 0.0 : static_cast<double>(sum_) / static_cast<double>(count_); }
  /// Smallest duration that a fraction q of all samples do not exceed [ns]; 0 when empty.
  std::int64_t percentile(double q) const noexcept;

 private:
  static constexpr int kSubBuckets = 32;
  static constexpr int kBuckets = 64 * kSubBuckets;
  static int bucketOf(std::int64_t nanoseconds) noexcept;
  static std::int64_t upperEdge(int bucket) noexcept;
  std::array<std::uint32_t, kBuckets> buckets_{};
  std::uint64_t count_ = 0;
  std::int64_t sum_ = 0;
  std::int64_t max_ = 0;
};

/// Timing of one rate group [ns]. Execution is the duration of a tick by Executor::timeBy's clock. Period and
/// lateness are real time only; in lockstep, which has no deadlines, they stay empty.
struct GroupTiming {
  // counters are atomic for the live display; the histograms are read after the run
  std::atomic<std::uint64_t> ticks{0};    ///< ticks run
  std::atomic<std::uint64_t> missed{0};   ///< ticks that began more than one period late
  std::atomic<std::uint64_t> skipped{0};  ///< ticks skipped after a stall too long to catch up
  DurationHistogram execution;            ///< duration of a tick
  DurationHistogram period;               ///< from the begin of a tick to that of the next one run
  DurationHistogram lateness;             ///< begin of a tick after its deadline
};

}  // namespace presa
