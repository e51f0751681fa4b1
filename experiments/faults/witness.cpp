#include "experiments/faults/witness.h"

#include <pthread.h>
#include <sched.h>

#include <algorithm>

#include "framework/core/schedule/clock.h"

namespace presa::faults {
namespace {

constexpr int kPriority = 86;  // above the supervisor's 84
constexpr auto kPeriodNs = static_cast<std::int64_t>(Witness::kPeriod * 1e9);
constexpr auto kGapNs = static_cast<std::int64_t>(Witness::kGap * 1e9);

}  // namespace

Witness::Witness() {
  cpu_set_t mine;
  CPU_ZERO(&mine);
  sched_getaffinity(0, sizeof mine, &mine);
  std::vector<int> processors;
  for (int i = 0; i < CPU_SETSIZE; ++i) {
    if (CPU_ISSET(i, &mine)) processors.push_back(i);
  }
  notes_.resize(processors.size());
  for (Notes& notes : notes_) notes.at_ns.resize(kNotes);
  for (std::size_t i = 0; i < processors.size(); ++i)
    threads_.emplace_back([this, processor = processors[i], &notes = notes_[i]] { watch(processor, notes); });
}

Witness::~Witness() { stop(); }

void Witness::watch(int processor, Notes& notes) const {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(processor, &one);
  pthread_setaffinity_np(pthread_self(), sizeof one, &one);
  const sched_param priority{.sched_priority = kPriority};
  pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority);
  for (std::int64_t next = monotonicNs(); !stop_.load(std::memory_order_relaxed) && notes.count < kNotes;) {
    notes.at_ns[notes.count++] = monotonicNs();
    next = std::max(next + kPeriodNs, notes.at_ns[notes.count - 1]);
    sleepUntilNs(next);
  }
}

void Witness::stop() {
  stop_.store(true, std::memory_order_relaxed);
  threads_.clear();
}

double Witness::heldUp(std::int64_t begin_ns, std::int64_t end_ns) const {
  struct Interval {
    std::int64_t begin, end;
  };
  std::vector<Interval> gaps;
  for (const Notes& notes : notes_) {
    for (std::size_t i = 1; i < notes.count; ++i) {
      const std::int64_t from = notes.at_ns[i - 1], to = notes.at_ns[i];
      if (to - from <= kGapNs) continue;
      const Interval gap{std::max(from + kPeriodNs, begin_ns), std::min(to, end_ns)};
      if (gap.begin < gap.end) gaps.push_back(gap);
    }
  }
  std::ranges::sort(gaps, {}, &Interval::begin);
  std::int64_t sum = 0, covered = begin_ns;
  for (const Interval& gap : gaps) {
    sum += std::max<std::int64_t>(0, gap.end - std::max(gap.begin, covered));
    covered = std::max(covered, gap.end);
  }
  return static_cast<double>(sum) * 1e-9;
}

}  // namespace presa::faults
