#include "framework/session/realtime_rights.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstring>
#include <thread>

#include "framework/core/schedule/executor.h"

namespace presa {

RealtimeRights realtimeRights() {
  RealtimeRights rights;
  std::thread([&] {
    const sched_param param{.sched_priority = kHapticPriority};
    if (const int refused = pthread_setschedparam(pthread_self(), SCHED_FIFO, &param); refused != 0)
      rights.fifo = std::strerror(refused);
  }).join();
  if (mlockall(MCL_CURRENT) != 0) rights.memory = std::strerror(errno);
  munlockall();
  return rights;
}

}  // namespace presa
