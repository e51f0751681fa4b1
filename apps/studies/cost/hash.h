#pragma once
#include <cstdint>
#include <string>

namespace presa::cost {

/// FNV-1a of texts, each ended by a zero so that "ab" "c" is not "a" "bc".
class Hash {
 public:
  void add(const std::string& text) {
    for (const char c : text) byte(static_cast<unsigned char>(c));
    byte(0);
  }
  std::uint64_t value() const { return value_; }

 private:
  void byte(unsigned char b) { value_ = (value_ ^ b) * 0x100000001b3; }
  std::uint64_t value_ = 0xcbf29ce484222325;
};

}  // namespace presa::cost
