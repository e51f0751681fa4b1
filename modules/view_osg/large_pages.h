#pragma once

namespace presa::view {

/// Lets the heap grow at once by the textures of a picture, in pages of 2 MB where the system has them: in pages of
/// 4 KB, a still spends a quarter of its time in page faults. Only the first call in a process has an effect.
void growHeapInLargePages() noexcept;

}  // namespace presa::view
