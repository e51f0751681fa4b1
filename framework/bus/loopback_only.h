#pragma once

namespace presa::bus {

/// While an object exists, every IPv4 socket that its thread binds is bound to 127.0.0.1 and, where the kernel allows
/// it, to the interface lo, whatever address was requested. Reason: Cyclone DDS 0.10 binds its receiving sockets to
/// 0.0.0.0 regardless of the configured interface and has no setting for it, and packets may arrive as soon as a socket
/// is bound. Works by interposing the C library's bind(): the dynamic linker finds this library first.
/// Thread: the one that creates it; objects may be nested.
class LoopbackOnly {
 public:
  LoopbackOnly() noexcept;
  ~LoopbackOnly();
  LoopbackOnly(const LoopbackOnly&) = delete;
  LoopbackOnly& operator=(const LoopbackOnly&) = delete;
  /// Number of sockets bound to the loopback address since construction.
  int bound() const noexcept;

 private:
  int before_;
};

}  // namespace presa::bus
