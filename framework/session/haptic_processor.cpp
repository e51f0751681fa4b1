#include "framework/session/haptic_processor.h"

#include <sched.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <string>

#include "framework/session/realtime_rights.h"

namespace presa {
namespace {

/// Claims a processor among all processes of this machine: the system gives an abstract socket name to one process at a
/// time, and takes it back however that process ends. Returns a descriptor, or -1 when another process has it.
int claim(int processor) {
  const int descriptor = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const std::string name = "presa/haptic_processor/" + std::to_string(processor);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::copy(name.begin(), name.end(), address.sun_path + 1);  // after a zero: abstract, no file
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  if (bind(descriptor, reinterpret_cast<const sockaddr*>(&address), size) == 0) return descriptor;
  close(descriptor);
  return -1;
}

bool bindTo(const cpu_set_t& processors) noexcept { return sched_setaffinity(0, sizeof processors, &processors) == 0; }

}  // namespace

HapticProcessor::HapticProcessor() {
  cpu_set_t others;
  if (sched_getaffinity(0, sizeof others, &others) != 0 || CPU_COUNT(&others) < 2 || !fifoRefusal().empty()) return;
  for (int processor = CPU_SETSIZE - 1; processor >= 0 && number_ < 0; --processor) {
    if (!CPU_ISSET(processor, &others)) continue;
    claim_ = claim(processor);
    if (claim_ >= 0) number_ = processor;
  }
  if (number_ < 0) return;
  CPU_CLR(number_, &others);
  bindTo(others);
}

HapticProcessor::~HapticProcessor() {
  if (number_ < 0) return;
  cpu_set_t all;
  if (sched_getaffinity(0, sizeof all, &all) == 0) {
    CPU_SET(number_, &all);
    bindTo(all);
  }
  close(claim_);
}

void HapticProcessor::bindCaller() const noexcept {
  if (number_ < 0) return;
  cpu_set_t own;
  CPU_ZERO(&own);
  CPU_SET(number_, &own);
  bindTo(own);
}

}  // namespace presa
