#include "devices/falcon_model/serial_line.h"

#include <algorithm>
#include <limits>

namespace presa::falcon_model {
namespace {

constexpr double kBits = 10;          // start bit, eight data bits, stop bit
constexpr double kSameMoment = 1e-9;  // tolerance between accumulated clocks [s]

/// Baud rate: 3 MHz divided by a whole number and eighths [FTDI AN120]; nullopt for an invalid one.
std::optional<double> baudOf(std::uint16_t value) {
  constexpr double kEighths[] = {0, 0.5, 0.25, 0.125};
  const int whole = value & 0x3FFF;
  if (whole < 2) return std::nullopt;
  return 3e6 / (whole + kEighths[value >> 14]);
}

/// The value that a receiver at another rate reads; never the original one.
std::uint8_t garbled(std::uint8_t value) { return static_cast<std::uint8_t>((value * 167U + 0x5DU) | 0x80U); }

}  // namespace

bool SerialLine::request(std::uint8_t request, std::uint16_t value, double now) {
  switch (request) {
    case 0:
      if (value > 2) return false;
      if (value != 2) to_host_.clear(), return_free_ = now;
      if (value != 1) to_processor_.clear(), wire_free_ = now;
      return true;
    case 1:  // the high byte selects the line, the low byte is its level
      if ((value & 0x0100) != 0) dtr_ = (value & 1) != 0;
      if ((value & 0x0200) != 0) rts_ = (value & 2) != 0;
      return (value & ~0x0303) == 0;
    case 2:
      return value == 0;
    case 3: {
      const std::optional<double> baud = baudOf(value);
      baud_ = baud.value_or(baud_);
      return baud.has_value();
    }
    case 4:
      eight_bits_ = value == 8;
      return true;
    case 9:
      if (value < 1 || value > 255) return false;
      latency_ = 1e-3 * value;
      return true;
    default:
      return false;
  }
}

bool SerialLine::hostWrites(std::span<const std::uint8_t> bytes, std::uint32_t tag, double now) {
  const auto waiting = std::ranges::count_if(to_processor_, [now](const WireByte& b) { return b.time > now; });
  if (static_cast<std::size_t>(waiting) + bytes.size() > kFifo) return false;
  wire_free_ = std::max(wire_free_, now);
  for (const std::uint8_t value : bytes) {
    wire_free_ += kBits / baud_;
    to_processor_.push_back({wire_free_, baud_, value, tag});
  }
  return true;
}

std::optional<WireByte> SerialLine::atProcessor(double now) {
  if (to_processor_.empty() || to_processor_.front().time > now) return std::nullopt;
  const WireByte byte = to_processor_.front();
  to_processor_.pop_front();
  return byte;
}

void SerialLine::processorWrites(std::span<const std::uint8_t> bytes, double baud, std::uint32_t tag, double time) {
  return_free_ = std::max(return_free_, time);
  for (const std::uint8_t value : bytes) {
    return_free_ += kBits / baud;
    if (to_host_.size() >= kReturnFifo) continue;  // overrun: the byte is lost
    to_host_.push_back({return_free_, baud, baud == baud_ ? value : garbled(value), tag});
  }
}

std::optional<SerialLine::Packet> SerialLine::toHost(double now, double asked) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double full = to_host_.size() >= kPacket ? to_host_[kPacket - 1].time : kNever;
  const double time = std::max({packet_sent_, asked, std::min(full, packet_sent_ + latency_)});
  if (time > now + kSameMoment) return std::nullopt;
  Packet packet;
  packet.time = packet_sent_ = time;
  while (!to_host_.empty() && to_host_.front().time <= time && packet.bytes.size() < kPacket) {
    packet.bytes.push_back(to_host_.front());
    to_host_.pop_front();
  }
  return packet;
}

}  // namespace presa::falcon_model
