#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>

#include "framework/core/math/fnv.h"
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
class StateHash {
 public:
  void add(const DeviceState& state) noexcept;
  void add(const ContactExchange& state) noexcept;
  void add(const ObjectState& state) noexcept;
  std::uint64_t value() const noexcept { return hash_.value(); }

 private:
  template <class Word>
  void addWord(Word word) noexcept {
    word == 0 ? hash_.addZeros<sizeof(Word)>() : hash_.addWord(word);  // faster: most bodies do not move
  }
  void add(double value) noexcept { addWord(std::bit_cast<std::uint64_t>(value)); }
  void add(std::int32_t value) noexcept { addWord(static_cast<std::uint32_t>(value)); }
  void add(std::uint32_t value) noexcept { addWord(value); }
  void add(bool value) noexcept { hash_.add(std::uint8_t{value}); }
  void add(const Vec3& v) noexcept;
  void add(const Pose& pose) noexcept;
  void add(const FingerContact& finger) noexcept;

  Fnv1a hash_;
};

}  // namespace presa
