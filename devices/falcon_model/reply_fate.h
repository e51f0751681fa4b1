#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "framework/core/math/random.h"

/// Faults of replies in transit. Thread: any.
namespace presa::falcon_model {

/// One reply before it is sent.
struct ReplyFate {
  std::vector<std::uint8_t> bytes;
  std::size_t first = std::numeric_limits<std::size_t>::max();  ///< number of bytes sent at once;
  double pause = 0;                                             ///< the rest follows after this time [s]
  bool waits = false;                                           ///< sent together with the next reply
};

/// Removes two bytes, as seen on real devices; not the closing one.
inline void shorten(ReplyFate& reply, RandomStream& random) {
  for (int i = 0; i < 2; ++i) {
    reply.bytes.erase(reply.bytes.begin() + static_cast<std::ptrdiff_t>(random.below(reply.bytes.size() - 1)));
  }
}
/// Splits a reply into two packets.
inline void split(ReplyFate& reply, RandomStream& random) {
  if (reply.bytes.size() < 2) return;
  reply.first = 1 + random.below(reply.bytes.size() - 1);
  reply.pause = 0.0015;
}
inline void flipBits(ReplyFate& reply, RandomStream& random, int bits) {
  for (int i = 0; i < bits; ++i) {
    reply.bytes[random.below(reply.bytes.size())] ^= static_cast<std::uint8_t>(1U << random.below(8));
  }
}

}  // namespace presa::falcon_model
