#include "framework/session/haptic_processor.h"

#include <sched.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <functional>
#include <string>
#include <utility>
#include <vector>

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

/// Highest clock frequency [kHz]; 0: the system does not say.
long clockOf(int processor) {
  std::ifstream file("/sys/devices/system/cpu/cpu" + std::to_string(processor) + "/cpufreq/cpuinfo_max_freq");
  long kilohertz = 0;
  file >> kilohertz;
  return kilohertz;
}

/// The fastest first, for some machines have slow ones beside fast ones; among equals the last first.
std::vector<int> inOrder(const cpu_set_t& processors) {
  std::vector<std::pair<long, int>> found;
  for (int i = 0; i < CPU_SETSIZE; ++i)
    if (CPU_ISSET(i, &processors)) found.emplace_back(clockOf(i), i);
  std::ranges::sort(found, std::greater{});
  std::vector<int> order;
  for (const auto& [clock, processor] : found) order.push_back(processor);
  return order;
}

bool bindTo(const cpu_set_t& processors) noexcept { return sched_setaffinity(0, sizeof processors, &processors) == 0; }

}  // namespace

HapticProcessor::HapticProcessor() {
  cpu_set_t others;
  if (sched_getaffinity(0, sizeof others, &others) != 0 || CPU_COUNT(&others) < 2 || !fifoRefusal().empty()) return;
  for (const int processor : inOrder(others)) {
    claim_ = claim(processor);
    if (claim_ < 0) continue;
    number_ = processor;
    break;
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
