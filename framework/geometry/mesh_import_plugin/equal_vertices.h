#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace presa {

/// Numbers vertices so that equal ones get one number. Assimp delivers a corner of n triangles n times in most formats;
/// what is not sent through the pipe need not be welded. `At` gives the `count` numbers of vertex v.
template <std::size_t count, class At>
class EqualVertices {
 public:
  EqualVertices(std::size_t vertices, At at) : at_(at), table_(std::bit_ceil(2 * vertices + 1), kNone) {}

  /// The first vertex that is equal to v, bit for bit; v itself if there was none before.
  unsigned firstOf(unsigned v) {
    const Bits bits = bitsOf(v);
    std::uint64_t h = 0;
    for (const std::uint32_t word : bits) h = (h ^ word) * 0x9e3779b97f4a7c15u, h ^= h >> 29;
    const std::size_t mask = table_.size() - 1;
    for (std::size_t at = h & mask;; at = (at + 1) & mask) {
      if (table_[at] == kNone) return table_[at] = v;
      if (bitsOf(table_[at]) == bits) return table_[at];
    }
  }

 private:
  using Bits = std::array<std::uint32_t, count>;
  static constexpr unsigned kNone = ~0U;
  Bits bitsOf(unsigned v) const {
    Bits bits{};
    const std::array<float, count> numbers = at_(v);
    for (std::size_t i = 0; i < count; ++i) bits[i] = std::bit_cast<std::uint32_t>(numbers[i]);
    return bits;
  }
  At at_;
  std::vector<unsigned> table_;  // open addressing; at most half full
};

}  // namespace presa
