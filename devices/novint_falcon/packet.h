#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "devices/novint_falcon/byte_ring.h"

/// Packets of a Novint Falcon in operation, 16 bytes each way. A 16-bit value is sent as four bytes, least significant
/// nibble first, each 0x41 + nibble. Thread: any; nonblocking, nothing is allocated.
namespace presa::falcon {

inline constexpr std::size_t kPacketSize = 16;
inline constexpr int kMaxCounts = 4095;  ///< max magnitude of a motor command

using Counts = std::array<std::int32_t, 3>;  ///< one per motor or encoder

enum Light : std::uint8_t { kLightsOff = 0, kGreen = 0x2, kBlue = 0x4, kRed = 0x8 };
enum Button : std::uint8_t { kButtonPlus = 0x1, kButtonForward = 0x2, kButtonCentre = 0x4, kButtonMinus = 0x8 };
inline constexpr std::uint8_t kAllHomed = 0x7;

struct Request {
  Counts force{};                   ///< each within +-kMaxCounts
  std::uint8_t light = kLightsOff;  ///< Light bits
  bool homing = true;               ///< must be set in every request
};

struct Reply {
  Counts encoders{};         ///< in -32768..32767
  std::uint8_t buttons = 0;  ///< Button bits
  std::uint8_t homed = 0;    ///< bit i: encoder i has passed its reference; kAllHomed: all
};

using Packet = std::array<std::uint8_t, kPacketSize>;

/// Encodes a request. If any count is out of range, all forces are sent as zero, never truncated to their low bits.
Packet encode(const Request& request) noexcept;

/// Finds replies in a byte stream that may start, stop and restart anywhere. A reply is `<`, twelve bytes in
/// 0x41..0x50, one in 0x41..0xC0, one unchecked byte, `>`. After a mismatch the parser drops one byte and tries again.
/// Memory is fixed: on overflow the oldest bytes are dropped.
class PacketParser {
 public:
  /// Discards incomplete data: after a purge or a change of the baud rate.
  void reset() noexcept;
  void push(std::span<const std::uint8_t> bytes) noexcept;
  /// The oldest complete reply; false when there is none.
  bool next(Reply& reply) noexcept;

  std::uint64_t accepted() const noexcept { return accepted_; }
  std::uint64_t dropped() const noexcept { return dropped_; }  ///< bytes that did not belong to a reply

  static constexpr std::size_t kCapacity = 512;

 private:
  /// Number of leading bytes, up to a whole packet, that could be a reply.
  std::size_t plausible() const noexcept;
  void drop(std::size_t count) noexcept;

  ByteRing<kCapacity> ring_;
  std::uint64_t accepted_ = 0, dropped_ = 0;
};

}  // namespace presa::falcon
