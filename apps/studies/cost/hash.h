#pragma once
#include <cstdint>
#include <string>

#include "framework/core/math/fnv.h"

namespace presa::cost {

/// Hash of a sequence of texts. Each text is terminated by a zero so that "ab" "c" and "a" "bc" differ.
class Hash {
 public:
  void add(const std::string& text) {
    hash_.add(text);
    hash_.add(std::uint8_t{0});
  }
  std::uint64_t value() const { return hash_.value(); }

 private:
  Fnv1a hash_;
};

}  // namespace presa::cost
