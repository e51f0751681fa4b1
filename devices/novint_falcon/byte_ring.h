#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace presa::falcon {

/// A byte FIFO in fixed memory; when it is full, the oldest byte is dropped.
template <std::size_t kCapacity>
class ByteRing {
 public:
  void push(std::uint8_t byte) noexcept {
    if (size_ == kCapacity) drop(1);
    bytes_[(first_ + size_++) % kCapacity] = byte;
  }
  /// count <= size()
  void drop(std::size_t count) noexcept {
    first_ = (first_ + count) % kCapacity;
    size_ -= count;
  }
  std::uint8_t operator[](std::size_t i) const noexcept { return bytes_[(first_ + i) % kCapacity]; }
  std::size_t size() const noexcept { return size_; }

 private:
  std::array<std::uint8_t, kCapacity> bytes_{};
  std::size_t first_ = 0, size_ = 0;
};

}  // namespace presa::falcon
