#include "framework/core/schedule/timing_stats.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace presa {
namespace {

/// 2^(k/32) for k = 0 … 32: lower edges of the buckets within one octave.
struct OctaveEdges {
  std::array<double, 33> edge{};
  OctaveEdges() {
    for (std::size_t k = 0; k < edge.size(); ++k) edge[k] = std::exp2(static_cast<double>(k) / 32.0);
  }
};
// constructed while the library loads, so that add() needs no first-use guard
const OctaveEdges kOctave;

}  // namespace

int DurationHistogram::bucketOf(std::int64_t nanoseconds) noexcept {
  // no integer lies strictly between 1 and 2, so buckets 0 and 1 of the lowest octave hold 0 and 1
  if (nanoseconds < 2) return static_cast<int>(nanoseconds);
  const int octave = std::bit_width(static_cast<std::uint64_t>(nanoseconds)) - 1;
  const double mantissa = std::ldexp(static_cast<double>(nanoseconds), -octave);
  const auto above = std::upper_bound(kOctave.edge.begin() + 1, kOctave.edge.end() - 1, mantissa);
  const int bucket = octave * kSubBuckets + static_cast<int>(above - kOctave.edge.begin()) - 1;
  return std::min(bucket, kBuckets - 1);
}

std::int64_t DurationHistogram::upperEdge(int bucket) noexcept {
  if (bucket < 2) return bucket;
  const int octave = bucket / kSubBuckets;
  const auto next = static_cast<std::size_t>(bucket % kSubBuckets) + 1;
  // the largest integer below the next bucket's lower edge
  return static_cast<std::int64_t>(std::ceil(std::ldexp(kOctave.edge[next], octave))) - 1;
}

void DurationHistogram::add(std::int64_t nanoseconds) noexcept {
  const std::int64_t duration = std::max<std::int64_t>(nanoseconds, 0);
  ++buckets_[static_cast<std::size_t>(bucketOf(duration))];
  ++count_;
  sum_ += duration;
  max_ = std::max(max_, duration);
}

std::int64_t DurationHistogram::percentile(double q) const noexcept {
  if (count_ == 0) return 0;
  const double wanted = std::ceil(std::clamp(q, 0.0, 1.0) * static_cast<double>(count_));
  const std::uint64_t rank = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(wanted));
  std::uint64_t seen = 0;
  for (int bucket = 0; bucket < kBuckets; ++bucket) {
    seen += buckets_[static_cast<std::size_t>(bucket)];
    if (seen >= rank) return std::min(upperEdge(bucket), max_);
  }
  return max_;
}

}  // namespace presa
