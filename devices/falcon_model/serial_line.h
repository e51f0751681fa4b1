#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

/// The serial converter (FTDI FT232) between USB and the device's processor, and the wires behind it: bytes take their time, at the
/// rate that was set, and come back when 62 of them are there or the latency timer ends. Times in seconds on the owner's clock,
/// never backwards. Thread: the owner's.
namespace presa::falcon_model {

/// A byte on a wire. `tag`: whatever its sender wants to be known when it arrives.
struct WireByte {
  double time = 0;  ///< its last bit is there [s]
  double baud = 0;  ///< of the sender
  std::uint8_t value = 0;
  std::uint32_t tag = 0;
};

class SerialLine {
 public:
  /// A vendor request; false: the converter does not know it (the bus says "stall").
  bool request(std::uint8_t request, std::uint16_t value, double now);

  double baud() const { return baud_; }
  bool dtr() const { return dtr_; }
  bool rts() const { return rts_; }
  bool eightBitsNoParity() const { return eight_bits_; }
  double latency() const { return latency_; }  ///< [s]

  /// From the host; false, and nothing is taken, while there is no room.
  bool hostWrites(std::span<const std::uint8_t> bytes, std::uint32_t tag, double now);
  /// The next byte that is at the processor by `now`.
  std::optional<WireByte> atProcessor(double now);
  /// From the processor, which starts at `time`.
  void processorWrites(std::span<const std::uint8_t> bytes, double baud, std::uint32_t tag, double time);

  /// An IN packet: its two status bytes are not in `bytes`.
  struct Packet {
    double time = 0;
    std::vector<WireByte> bytes;
  };
  /// The next one that goes to a host which has been asking since `asked`; may be without bytes.
  std::optional<Packet> toHost(double now, double asked);

  static constexpr std::uint8_t kStatus[2] = {0x01, 0x60};
  static constexpr std::size_t kPacket = 62;  ///< bytes of data in one of 64

 private:
  static constexpr std::size_t kFifo = 128, kReturnFifo = 256;

  double baud_ = 9600, latency_ = 0.016;
  bool dtr_ = false, rts_ = false, eight_bits_ = false;
  std::deque<WireByte> to_processor_, to_host_;
  double wire_free_ = 0, return_free_ = 0;  // from then on [s]
  double packet_sent_ = 0;
};

}  // namespace presa::falcon_model
