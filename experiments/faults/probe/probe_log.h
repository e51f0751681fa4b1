#pragma once
#include <sys/types.h>

#include <array>
#include <atomic>
#include <cstdint>

namespace presa::faults {

/// Forces written to a probe, in a file that the process under test maps and the test reads. It survives the process.
struct ProbeLog {
  struct Entry {
    std::int64_t time_ns = 0;  ///< CLOCK_MONOTONIC
    double force = 0;          ///< magnitude [N]
    double step = 0;           ///< change from the previous write [N]
  };
  static constexpr std::size_t kEntries = 1 << 16;  // 16 s at 4 kHz

  std::atomic<pid_t> writer{0};           ///< process that holds the device
  std::atomic<std::uint64_t> written{0};  ///< number of complete entries
  std::array<Entry, kEntries> entries;
};

}  // namespace presa::faults
