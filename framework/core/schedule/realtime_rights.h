#pragma once
#include <functional>
#include <string>

namespace presa {

/// What the system lets this process have of what keeps a haptic tick on time.
struct RealtimeRights {
  std::string fifo;    ///< why SCHED_FIFO is refused; empty: granted
  std::string memory;  ///< why memory cannot be locked; empty: granted
  bool granted() const { return fifo.empty() && memory.empty(); }
};

/// Asks by trying, on a thread of its own, and leaves nothing changed. Thread: main.
RealtimeRights realtimeRights();

/// Tests put another answer in its place.
using RealtimeProbe = std::function<RealtimeRights()>;

/// Of the haptic thread under SCHED_FIFO: above ordinary work and interrupts' soft part, below the kernel's watchdog threads (99).
inline constexpr int kHapticPriority = 80;

}  // namespace presa
