#include "devices/novint_falcon/packet.h"

#include <algorithm>

namespace presa::falcon {
namespace {

constexpr std::uint8_t kOpen = '<', kClose = '>';
constexpr std::uint8_t kZero = 0x41;  // encodes a nibble of 0, and an empty status
constexpr std::size_t kValues = 1, kStatus = 13, kUnspecified = 14, kEnd = 15;

void putValue(std::int32_t value, std::uint8_t* out) noexcept {
  const auto bits = static_cast<std::uint16_t>(value);
  for (unsigned nibble = 0; nibble < 4; ++nibble)
    out[nibble] = static_cast<std::uint8_t>(kZero + ((bits >> (4 * nibble)) & 0xFU));
}

bool mayStandAt(std::size_t position, std::uint8_t byte) noexcept {
  if (position == 0) return byte == kOpen;
  if (position < kStatus) return byte >= kZero && byte <= kZero + 0xF;
  if (position == kStatus) return byte >= kZero && byte <= kZero + 0x7F;
  return position == kUnspecified || byte == kClose;
}

bool inRange(const Counts& counts) noexcept {
  return std::all_of(counts.begin(), counts.end(), [](std::int32_t c) { return c >= -kMaxCounts && c <= kMaxCounts; });
}

}  // namespace

Packet encode(const Request& request) noexcept {
  Packet packet;
  packet[0] = kOpen;
  const Counts force = inRange(request.force) ? request.force : Counts{};
  for (std::size_t motor = 0; motor < force.size(); ++motor) putValue(force[motor], &packet[kValues + 4 * motor]);
  packet[kStatus] = static_cast<std::uint8_t>(kZero + ((request.light & 0xEU) | (request.homing ? 1U : 0U)));
  packet[kUnspecified] = kZero;
  packet[kEnd] = kClose;
  return packet;
}

void PacketParser::reset() noexcept { drop(ring_.size()); }

void PacketParser::push(std::span<const std::uint8_t> bytes) noexcept {
  for (const std::uint8_t byte : bytes) {
    dropped_ += ring_.size() == kCapacity ? 1 : 0;
    ring_.push(byte);
  }
}

std::size_t PacketParser::plausible() const noexcept {
  const std::size_t present = std::min(ring_.size(), kPacketSize);
  std::size_t good = 0;
  while (good < present && mayStandAt(good, ring_[good])) ++good;
  return good;
}

void PacketParser::drop(std::size_t count) noexcept {
  ring_.drop(count);
  dropped_ += count;
}

bool PacketParser::next(Reply& reply) noexcept {
  while (ring_.size() > 0) {
    const std::size_t good = plausible();
    if (good == kPacketSize) break;
    if (good == ring_.size()) return false;  // incomplete so far: wait for the rest
    drop(1);
  }
  if (ring_.size() == 0) return false;
  for (std::size_t encoder = 0; encoder < reply.encoders.size(); ++encoder) {
    std::uint16_t bits = 0;
    for (std::size_t nibble = 0; nibble < 4; ++nibble)
      bits = static_cast<std::uint16_t>(bits | (ring_[kValues + 4 * encoder + nibble] - kZero) << (4 * nibble));
    reply.encoders[encoder] = static_cast<std::int16_t>(bits);
  }
  const auto status = static_cast<std::uint8_t>(ring_[kStatus] - kZero);
  reply.buttons = status & 0xFU;
  reply.homed = (status >> 4U) & kAllHomed;
  ring_.drop(kPacketSize);
  ++accepted_;
  return true;
}

}  // namespace presa::falcon
