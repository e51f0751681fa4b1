#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "framework/core/schedule/clock.h"

namespace presa::bench {

/// Cost of reading the thread's processor clock twice [ns]: the median, measured once. It is subtracted from every
/// window.
inline double clockNs() {
  static const double cost = [] {
    std::vector<std::int64_t> reads(10'001);
    for (std::int64_t& read : reads) {
      const std::int64_t begin = threadCpuNs();
      read = threadCpuNs() - begin;
    }
    std::ranges::nth_element(reads, reads.begin() + 5000);
    return static_cast<double>(reads[5000]);
  }();
  return cost;
}

/// Times of a series of windows that is repeated with identical work. Interrupts of the machine (tens of us of
/// processor time each) hit other windows in every run, so the min over the runs is a window's own cost.
class Windows {
 public:
  explicit Windows(std::size_t count) : own_(count, std::numeric_limits<double>::infinity()) {}

  void add(std::size_t window, std::int64_t ns) {
    const double us = std::max(0.0, static_cast<double>(ns) - clockNs()) * 1e-3;
    own_[window] = std::min(own_[window], us);
    raw_.push_back(us);
  }
  double own(double share) const { return at(own_, share); }
  double raw(double share) const { return at(raw_, share); }
  double mean() const {
    double sum = 0;
    for (const double us : own_) sum += us;
    return sum / static_cast<double>(own_.size());
  }

 private:
  static double at(std::vector<double> all, double share) {
    const auto n = static_cast<std::ptrdiff_t>(share * static_cast<double>(all.size() - 1));
    std::nth_element(all.begin(), all.begin() + n, all.end());
    return all[static_cast<std::size_t>(n)];
  }
  std::vector<double> own_, raw_;  // [us]
};

/// Runs `work` and returns its processor time [ns].
template <class Work>
std::int64_t cpuNsOf(const Work& work) {
  const std::int64_t begin = threadCpuNs();
  work();
  return threadCpuNs() - begin;
}

}  // namespace presa::bench
