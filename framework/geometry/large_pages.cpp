#include "framework/geometry/large_pages.h"

#include <malloc.h>
#include <sys/mman.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace presa {

void growHeapInLargePages([[maybe_unused]] int blocks) noexcept {
#ifdef __GLIBC__
  constexpr std::size_t kPage = 2U << 20U, kBlock = 24U << 20U;
  constexpr int kLargestOnHeap = 32 << 20;  // the highest threshold that glibc accepts
  mallopt(M_MMAP_THRESHOLD, kLargestOnHeap);
  mallopt(M_TRIM_THRESHOLD, (blocks + 1) * static_cast<int>(kBlock));
  std::array<void*, 5> heap{};
  for (int i = 0; i < blocks && i < static_cast<int>(heap.size()); ++i) {
    void*& block = heap[static_cast<std::size_t>(i)];
    block = std::malloc(kBlock);
    const auto begin = (reinterpret_cast<std::uintptr_t>(block) + kPage - 1) / kPage * kPage;
    // to the page that reaches into the next block; a system without large pages refuses, and the heap is as it was
    if (block != nullptr) madvise(reinterpret_cast<void*>(begin), kBlock, MADV_HUGEPAGE);
  }
  for (void* const block : heap) std::free(block);
#endif
}

}  // namespace presa
