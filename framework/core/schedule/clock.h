#pragma once
#include <cstdint>
#include <ctime>

namespace presa {

/// CLOCK_MONOTONIC [ns]: never jumps with the wall clock.
inline std::int64_t monotonicNs() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

/// Time that the machine has been suspended since boot [ns]; CLOCK_MONOTONIC does not count it.
inline std::int64_t sleptNs() noexcept {
  timespec boot{};
  clock_gettime(CLOCK_BOOTTIME, &boot);
  return static_cast<std::int64_t>(boot.tv_sec) * 1'000'000'000 + boot.tv_nsec - monotonicNs();
}

/// Processor time of the calling thread [ns]; stands still while other threads run. Costs a system call.
inline std::int64_t threadCpuNs() noexcept {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

/// Sleeps until `deadline` on CLOCK_MONOTONIC [ns]; returns at once when it has passed.
inline void sleepUntilNs(std::int64_t deadline) noexcept {
  const timespec until{deadline / 1'000'000'000, deadline % 1'000'000'000};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != 0) {
  }
}

}  // namespace presa
