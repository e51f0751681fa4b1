#pragma once
#include <cstdint>
#include <ctime>

namespace presa {

/// A clock of the system [ns].
inline std::int64_t readNs(clockid_t clock) noexcept {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}
/// Never jumps with the wall clock [ns].
inline std::int64_t monotonicNs() noexcept { return readNs(CLOCK_MONOTONIC); }
/// Time that the machine has been suspended since boot [ns]; CLOCK_MONOTONIC does not count it.
inline std::int64_t sleptNs() noexcept { return readNs(CLOCK_BOOTTIME) - monotonicNs(); }
/// Processor time of the calling thread [ns]; stands still while other threads run. Costs a system call.
inline std::int64_t threadCpuNs() noexcept { return readNs(CLOCK_THREAD_CPUTIME_ID); }

/// Sleeps until `deadline` on CLOCK_MONOTONIC [ns]; returns at once when it has passed.
inline void sleepUntilNs(std::int64_t deadline) noexcept {
  const timespec until{deadline / 1'000'000'000, deadline % 1'000'000'000};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != 0) {
  }
}

}  // namespace presa
