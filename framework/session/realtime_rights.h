#pragma once
#include <functional>
#include <string>

namespace presa {

/// The real-time rights that the system grants or refuses this process.
struct RealtimeRights {
  std::string fifo;    ///< why SCHED_FIFO is refused; empty: granted
  std::string memory;  ///< why memory cannot be locked; empty: granted
  bool granted() const { return fifo.empty() && memory.empty(); }
};

/// Tries both rights, SCHED_FIFO on a temporary thread, and undoes them. Thread: main.
RealtimeRights realtimeRights();

/// Replaces realtimeRights() in tests.
using RealtimeProbe = std::function<RealtimeRights()>;

}  // namespace presa
