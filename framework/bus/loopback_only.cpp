#include "framework/bus/loopback_only.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

thread_local int depth = 0;
thread_local int bound_count = 0;

long bindAsAsked(int socket, const sockaddr* address, socklen_t length) noexcept {
  return syscall(SYS_bind, socket, address, length);
}

}  // namespace

// Replaces bind() for the whole process; without a LoopbackOnly on the calling thread it behaves as in the C library.
extern "C" __attribute__((visibility("default"))) int bind(int socket, const sockaddr* address,
                                                           socklen_t length) noexcept {
  if (depth == 0 || address == nullptr || length < sizeof(sockaddr_in) || address->sa_family != AF_INET)
    return static_cast<int>(bindAsAsked(socket, address, length));
  // route_localnet may route 127.0.0.1 from outside, so bind to the interface, too (before Linux 5.7 only root may do
  // this)
  setsockopt(socket, SOL_SOCKET, SO_BINDTODEVICE, "lo", sizeof "lo");
  sockaddr_in loopback = *reinterpret_cast<const sockaddr_in*>(address);
  loopback.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const long failed = bindAsAsked(socket, reinterpret_cast<const sockaddr*>(&loopback), sizeof loopback);
  if (failed == 0) ++bound_count;
  return static_cast<int>(failed);
}

namespace presa::bus {

LoopbackOnly::LoopbackOnly() noexcept : before_(bound_count) { ++depth; }
LoopbackOnly::~LoopbackOnly() { --depth; }
int LoopbackOnly::bound() const noexcept { return bound_count - before_; }

}  // namespace presa::bus
