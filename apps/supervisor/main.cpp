#include <fcntl.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <new>

#include "framework/device/supervision/supervisor.h"

namespace {

std::atomic<std::uint64_t> allocations{0};
std::uint64_t countAllocations() { return allocations.load(std::memory_order_relaxed); }

}  // namespace

// Counts allocations; the program sees the count in every cycle. A running supervisor must not allocate.
void* operator new(std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return std::malloc(size > 0 ? size : 1);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

int main() {
  constexpr int kShareFd = 3, kLifeFd = 4;
  if (fcntl(kShareFd, F_GETFD) < 0 || fcntl(kLifeFd, F_GETFD) < 0) {
    std::fputs(
        "presa_supervisor keeps one haptic device for a running Presa and takes its force to zero when Presa stops or "
        "dies.\nPresa starts it by itself; there is nothing to start by hand.\n",
        stderr);
    return 2;
  }
  return presa::superviseDevice(kShareFd, kLifeFd, countAllocations);
}
