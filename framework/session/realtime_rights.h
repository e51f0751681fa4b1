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

/// Why the system refuses SCHED_FIFO, tried on a temporary thread; empty: it grants it. Thread: any.
std::string fifoRefusal();

/// Tries both rights and undoes them. Thread: main.
RealtimeRights realtimeRights();

/// Replaces realtimeRights() in tests.
using RealtimeProbe = std::function<RealtimeRights()>;

}  // namespace presa
