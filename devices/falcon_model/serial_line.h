#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

/// The serial converter (FTDI FT232) between USB and the device's processor, with its wires: bytes take their
/// transmission time at the current rate, and return to the host when 62 are there or the latency timer expires. Times
/// in seconds on the owner's clock, never decreasing. Thread: the owner's.
namespace presa::falcon_model {

/// A byte on a wire. `tag`: information of the sender that is delivered with it.
struct WireByte {
  double time = 0;  ///< arrival of its last bit [s]
  double baud = 0;  ///< baud rate of the sender
  std::uint8_t value = 0;
  std::uint32_t tag = 0;
};

class SerialLine {
 public:
  /// A vendor request; false: unknown to the converter (the bus reports a stall).
  bool request(std::uint8_t request, std::uint16_t value, double now);

  double baud() const { return baud_; }
  bool dtr() const { return dtr_; }
  bool rts() const { return rts_; }
  bool eightBitsNoParity() const { return eight_bits_; }
  double latency() const { return latency_; }  ///< [s]

  /// Bytes from the host; false, and nothing is accepted, when there is no room.
  bool hostWrites(std::span<const std::uint8_t> bytes, std::uint32_t tag, double now);
  /// The next byte that has arrived at the processor by `now`.
  std::optional<WireByte> atProcessor(double now);
  /// Bytes from the processor, sent from `time` on.
  void processorWrites(std::span<const std::uint8_t> bytes, double baud, std::uint32_t tag, double time);

  /// An IN packet, without its two status bytes.
  struct Packet {
    double time = 0;
    std::vector<WireByte> bytes;
  };
  /// The next packet for a host that has been waiting since `asked`; may be empty.
  std::optional<Packet> toHost(double now, double asked);

  static constexpr std::uint8_t kStatus[2] = {0x01, 0x60};
  static constexpr std::size_t kPacket = 62;  ///< data bytes per packet of 64

 private:
  static constexpr std::size_t kFifo = 128, kReturnFifo = 256;

  double baud_ = 9600, latency_ = 0.016;
  bool dtr_ = false, rts_ = false, eight_bits_ = false;
  std::deque<WireByte> to_processor_, to_host_;
  double wire_free_ = 0, return_free_ = 0;  // times at which the wires become free [s]
  double packet_sent_ = 0;
};

}  // namespace presa::falcon_model
