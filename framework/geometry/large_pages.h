#pragma once

namespace presa {

/// Lets the heap of this thread grow at once by `blocks` (1 to 5) of 24 MB, in pages of 2 MB where the system has them,
/// and keeps them when they are free: work that touches much memory for a short time spends a quarter of that time, or
/// more, in the faults of pages of 4 KB. At most two blocks on another thread than the first of a process.
/// Thread: any, while loading.
void growHeapInLargePages(int blocks) noexcept;

}  // namespace presa
