#pragma once

namespace presa::bus {

/// While one lives, every IPv4 socket that this thread binds is bound to 127.0.0.1 and, where the kernel allows it, to the interface
/// lo, whatever address was asked for. Cyclone DDS 0.10 binds the sockets that it receives on to 0.0.0.0, whichever interface its
/// configuration names, and offers no setting for that; once they are bound it would be too late, since packets come at once.
/// It works by standing before the C library's bind(): this library is found first by whatever is loaded after it.
/// Thread: the one that makes it; objects may be nested.
class LoopbackOnly {
 public:
  LoopbackOnly() noexcept;
  ~LoopbackOnly();
  LoopbackOnly(const LoopbackOnly&) = delete;
  LoopbackOnly& operator=(const LoopbackOnly&) = delete;
  /// Sockets that were bound to the loopback since.
  int bound() const noexcept;

 private:
  int before_;
};

}  // namespace presa::bus
