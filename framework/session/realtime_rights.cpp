#include "framework/session/realtime_rights.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstring>
#include <thread>

#include "framework/core/schedule/executor.h"

namespace presa {

std::string fifoRefusal() {
  int refused = 0;
  std::thread([&] {
    const sched_param param{.sched_priority = kHapticPriority};
    refused = pthread_setschedparam(pthread_self(), SCHED_FIFO, &param);
  }).join();
  return refused == 0 ? "" : std::strerror(refused);
}

RealtimeRights realtimeRights() {
  RealtimeRights rights{.fifo = fifoRefusal(), .memory = {}};
  if (mlockall(MCL_CURRENT) != 0) rights.memory = std::strerror(errno);
  munlockall();
  return rights;
}

}  // namespace presa
