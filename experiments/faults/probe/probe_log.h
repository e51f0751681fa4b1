#pragma once
#include <sys/types.h>

#include <array>
#include <atomic>
#include <cstdint>

namespace presa::faults {

/// What was written to a probe, in a file that the process under test maps and somebody else reads: it outlives the process.
struct ProbeLog {
  struct Entry {
    std::int64_t time_ns = 0;  ///< CLOCK_MONOTONIC
    double force = 0;          ///< magnitude [N]
    double step = 0;           ///< from the one before [N]
  };
  static constexpr std::size_t kEntries = 1 << 16;  // 16 s at 4 kHz

  std::atomic<pid_t> writer{0};           ///< process that has the device
  std::atomic<std::uint64_t> written{0};  ///< entries below this are there
  std::array<Entry, kEntries> entries;
};

}  // namespace presa::faults
