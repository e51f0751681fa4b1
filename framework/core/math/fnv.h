#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace presa {

/// FNV-1a hash, 64 bit, byte by byte: the same on every machine. Not a cryptographic hash.
/// Source: [Fowler–Noll–Vo, FNV-1a 64]
class Fnv1a {
 public:
  constexpr void add(std::uint8_t byte) noexcept { value_ = (value_ ^ byte) * kPrime; }  ///< one byte
  /// The bytes of `text`, without its length.
  constexpr void add(std::string_view text) noexcept {
    for (const char c : text) add(static_cast<std::uint8_t>(c));
  }
  /// Adds the bytes of an unsigned number, the least significant first.
  template <class Word>
  constexpr void addWord(Word word) noexcept {
    for (unsigned shift = 0; shift < 8 * sizeof(Word); shift += 8) add(static_cast<std::uint8_t>(word >> shift));
  }
  /// Adds `count` bytes of zero in one multiplication.
  template <std::size_t count>
  constexpr void addZeros() noexcept {
    constexpr std::uint64_t kAll = power(kPrime, count);
    value_ *= kAll;
  }
  constexpr std::uint64_t value() const noexcept { return value_; }  ///< hash of all bytes so far

 private:
  static constexpr std::uint64_t kPrime = 0x100000001b3;
  static constexpr std::uint64_t power(std::uint64_t base, std::size_t exponent) {
    return exponent == 0 ? 1 : base * power(base, exponent - 1);
  }
  std::uint64_t value_ = 0xcbf29ce484222325;
};

}  // namespace presa
