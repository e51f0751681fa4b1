#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>

#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/object_state.h"

namespace presa {

/// FNV-1a, 64 bit, over the bits of the states in the order they are added. Equal hashes mean runs that are equal to
/// the bit: -0 differs from +0, NaNs with different bits differ, and padding is not read.
///
/// Order: device state, contact exchange, and the object state when a new one has arrived, tick after tick. Within a
/// state: members as declared, only entries in use; vectors x y z; quaternions w x y z; numbers least significant byte
/// first, booleans as one byte.
/// Source: [Fowler–Noll–Vo, FNV-1a 64]
class StateHash {
 public:
  void add(const DeviceState& state) noexcept;
  void add(const ContactExchange& state) noexcept;
  void add(const ObjectState& state) noexcept;
  std::uint64_t value() const noexcept { return hash_; }

  void addByte(std::uint8_t byte) noexcept {
    hash_ ^= byte;
    hash_ *= kPrime;
  }

 private:
  static constexpr std::uint64_t kPrime = 0x100000001b3ULL;
  static constexpr std::uint64_t power(std::uint64_t base, std::size_t exponent) {
    return exponent == 0 ? 1 : base * power(base, exponent - 1);
  }
  template <class Word>
  void addWord(Word word) noexcept {
    if (word == 0) {  // same result as byte by byte, faster: most of thousands of bodies do not move
      constexpr std::uint64_t kAll = power(kPrime, sizeof(Word));
      hash_ *= kAll;
      return;
    }
    for (unsigned shift = 0; shift < 8 * sizeof(Word); shift += 8) addByte(static_cast<std::uint8_t>(word >> shift));
  }
  void add(double value) noexcept { addWord(std::bit_cast<std::uint64_t>(value)); }
  void add(std::int32_t value) noexcept { addWord(static_cast<std::uint32_t>(value)); }
  void add(std::uint32_t value) noexcept { addWord(value); }
  void add(bool value) noexcept { addByte(value ? 1 : 0); }
  void add(const Vec3& v) noexcept;
  void add(const Pose& pose) noexcept;
  void add(const FingerContact& finger) noexcept;

  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace presa
