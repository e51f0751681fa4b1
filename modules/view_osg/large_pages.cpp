#include "modules/view_osg/large_pages.h"

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>

namespace presa::view {
namespace {

constexpr int kRoom = 96 << 20;           ///< what a still of 1280 x 720 touches [byte]
constexpr int kLargestOnHeap = 32 << 20;  ///< the highest threshold that glibc accepts [byte]
constexpr int kStep = 1 << 20;            ///< of the heap afterwards [byte]

char* endOfHeap() { return static_cast<char*>(sbrk(0)); }

bool grow() noexcept {
  mallopt(M_MMAP_THRESHOLD, kLargestOnHeap);  // so that textures come from the heap
  mallopt(M_TRIM_THRESHOLD, 2 * kRoom);
  mallopt(M_TOP_PAD, kRoom);
  char* const begin = endOfHeap();
  void* volatile block = std::malloc(kLargestOnHeap / 2);  // volatile: else the compiler drops both calls
  std::free(block);
  mallopt(M_TOP_PAD, kStep);
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  char* const from = begin + (page - reinterpret_cast<std::uintptr_t>(begin) % page) % page;
  // a system without large pages refuses, and the heap is as it was
  if (endOfHeap() > from) madvise(from, static_cast<std::size_t>(endOfHeap() - from), MADV_HUGEPAGE);
  return true;
}

}  // namespace

void growHeapInLargePages() noexcept { [[maybe_unused]] static const bool done = grow(); }

}  // namespace presa::view
