#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>

#include <algorithm>
#include <barrier>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <mutex>
#include <thread>

#include "framework/core/schedule/catch_up.h"
#include "framework/core/schedule/clock.h"
#include "framework/core/schedule/executor.h"

namespace presa {
namespace {

/// SCHED_FIFO priority; 0: none.
int priorityOf(RateGroup group) noexcept {
  if (group == RateGroup::kHaptic) return kHapticPriority;
  if (group == RateGroup::kDynamics) return 60;
  return group == RateGroup::kCollision ? 50 : 0;
}

// Touch the stack once, so that the first deep call does not fault a page in.
void prefaultStack() noexcept {
  volatile char stack[256 * 1024];
  for (std::size_t i = 0; i < sizeof stack; i += 4096) stack[i] = 0;
}

}  // namespace

struct RealtimeExecutor::Shared {
  explicit Shared(std::ptrdiff_t threads) : ready(threads), running(threads) {}
  std::barrier<> ready;
  std::atomic<std::ptrdiff_t> running;  // threads that have not ended
  std::atomic<std::int64_t> start_ns{0};
  std::atomic<bool> failed{false};
  std::mutex mutex;
  std::exception_ptr error;
  std::vector<std::string> notes;
};

void RealtimeExecutor::run(double duration) {
  std::vector<RateGroup> groups;
  for (int g = 0; g < kRateGroupCount; ++g) {
    if (graph_.runs(static_cast<RateGroup>(g))) groups.push_back(static_cast<RateGroup>(g));
  }
  if (mlockall(MCL_CURRENT) != 0) {
    notes_.push_back(std::string("memory is not locked (") + std::strerror(errno) +
                     "): a page fault may delay a tick; raise 'ulimit -l' or run as root");
  }
  Shared shared(static_cast<std::ptrdiff_t>(groups.size()));
  std::vector<std::thread> threads;
  for (RateGroup group : groups) threads.emplace_back([&, group] { runGroup(group, duration, shared); });
  while (shared.running.load() > 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    poll_();
  }
  for (std::thread& thread : threads) thread.join();
  munlockall();
  notes_.insert(notes_.end(), shared.notes.begin(), shared.notes.end());
  if (shared.error) std::rethrow_exception(shared.error);
}

void RealtimeExecutor::runGroup(RateGroup group, double duration, Shared& shared) {
  pthread_setname_np(pthread_self(), (std::string("presa-") + toString(group)).c_str());
  prctl(PR_SET_TIMERSLACK, 1);  // wake at the deadline, not up to 50 us later
  on_thread_(group);
  try {
    graph_.start(group);
  } catch (...) {
    const std::scoped_lock lock(shared.mutex);
    shared.error = std::current_exception();
    shared.failed = true;
  }
  if (const int priority = priorityOf(group); priority > 0) {
    const sched_param param{.sched_priority = priority};
    if (const int refused = pthread_setschedparam(pthread_self(), SCHED_FIFO, &param); refused != 0) {
      const std::scoped_lock lock(shared.mutex);
      shared.notes.push_back(std::string("the ") + toString(group) + " thread runs without SCHED_FIFO (" +
                             std::strerror(refused) + "): other programs may delay it");
    }
    prefaultStack();
  }
  shared.ready.arrive_and_wait();
  // the first thread to arrive sets the common start, 5 ms ahead so that all threads reach it
  std::int64_t unset = 0;
  shared.start_ns.compare_exchange_strong(unset, monotonicNs() + 5'000'000);
  if (!shared.failed) loop(group, duration, shared);
  try {
    graph_.stop(group);
  } catch (...) {
    const std::scoped_lock lock(shared.mutex);
    if (!shared.error) shared.error = std::current_exception();
  }
  --shared.running;
}

void RealtimeExecutor::loop(RateGroup group, double duration, Shared& shared) {
  GroupTiming& timing = timings_[static_cast<std::size_t>(group)];
  const std::int64_t start = shared.start_ns;
  const std::int64_t period = rates_.periodNs(group);
  const auto limit = static_cast<std::int64_t>(kCatchUpLimit * 1e9), gap = static_cast<std::int64_t>(kGap * 1e9);
  std::uint64_t end = rates_.ticksWithin(group, duration);
  const std::uint64_t fade = rates_.ticksWithin(group, kFadeTime);
  bool stopping = false;
  std::int64_t previous = 0;
  CatchUp catch_up(period);
  std::int64_t slept = sleptNs();

  for (std::uint64_t i = 0; i < end && !control_.abort.load(std::memory_order_relaxed); ++i) {
    sleepUntilNs(start + static_cast<std::int64_t>(i) * period);
    const std::int64_t now = monotonicNs();
    std::int64_t late = now - (start + static_cast<std::int64_t>(i) * period);
    timing.lateness.add(late);
    if (late > period) timing.missed.fetch_add(1, std::memory_order_relaxed);
    const std::int64_t slept_now = sleptNs();
    const bool resumed = late > gap || slept_now - slept > gap;
    slept = slept_now;
    if (late > limit) {
      const auto skip = std::min<std::uint64_t>(static_cast<std::uint64_t>(late / period), end - 1 - i);
      i += skip;
      late -= static_cast<std::int64_t>(skip) * period;
      timing.skipped.fetch_add(skip, std::memory_order_relaxed);
    }
    if (previous != 0) timing.period.add(now - previous);
    previous = now;
    stepTimed(group, i, {late >= period, catch_up.isCatchUp(now, late) && !resumed, resumed});
    if (group == RateGroup::kHaptic) {
      control_.time.store(rates_.tick(group, i + 1).time, std::memory_order_relaxed);
    }
    if (!stopping && control_.stop_requested.load(std::memory_order_relaxed)) {
      stopping = true;
      end = std::min(end, i + 1 + fade);
    }
  }
  if (group != RateGroup::kHaptic) return;
  // the last tick covers the time up to the next deadline
  sleepUntilNs(start + static_cast<std::int64_t>(end) * period);
  wall_seconds_ = static_cast<double>(monotonicNs() - start) * 1e-9;
}

}  // namespace presa
