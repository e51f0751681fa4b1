#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

/// The USB functions that the driver needs; implemented for a real bus and for a model of the device.
namespace presa::falcon {

/// Settings of the serial converter (FTDI FT232) in front of the device's processor.
enum class Control : std::uint8_t {
  kReset,
  kPurgeReceive,
  kPurgeTransmit,
  kDtrHigh,
  kDtrLow,
  kRtsLow,
  kNoFlowControl,
  kBaud9600,     ///< greeting the boot loader
  kBaud140000,   ///< firmware
  kBaud1500000,  ///< operation
  kEightBitsNoParity,
  kLatency16ms,
  kLatency1ms,
};

/// The corresponding FTDI vendor request: bmRequestType 0x40, wIndex 0, no data.
struct FtdiRequest {
  std::uint8_t request = 0;
  std::uint16_t value = 0;
  bool operator==(const FtdiRequest&) const = default;
};

constexpr FtdiRequest ftdiRequestOf(Control control) noexcept {
  switch (control) {
    case Control::kReset:
      return {0, 0};
    case Control::kPurgeReceive:
      return {0, 1};
    case Control::kPurgeTransmit:
      return {0, 2};
    case Control::kDtrHigh:
      return {1, 0x0101};
    case Control::kDtrLow:
      return {1, 0x0100};
    case Control::kRtsLow:
      return {1, 0x0200};
    case Control::kNoFlowControl:
      return {2, 0};
    case Control::kBaud9600:
      return {3, 0x4138};  // 3 MHz / 312.5
    case Control::kBaud140000:
      return {3, 0x0015};  // 3 MHz / 21
    case Control::kBaud1500000:
      return {3, 0x0002};  // 3 MHz / 2
    case Control::kEightBitsNoParity:
      return {4, 8};
    case Control::kLatency16ms:
      return {9, 16};
    case Control::kLatency1ms:
      return {9, 1};
  }
  return {};
}

inline constexpr std::size_t kMaxWrite = 64;  ///< [byte]

/// An open device. `now` is the caller's time [s], from the same clock at every call and never decreasing; a real bus
/// ignores it. Thread: the one that steps the link.
class FalconTransport {
 public:
  virtual ~FalconTransport() = default;

  /// Sends a setting and waits for the device, at most 0.1 s; used during start-up, never in operation. A purge also
  /// discards received bytes that were not read. False: refused, timed out or lost.
  virtual bool control(Control control, double now) noexcept = 0;

  /// Sends all of `bytes` (at most kMaxWrite) without waiting. False, and nothing is sent, when the previous write is
  /// still in transit or the device is lost.
  virtual bool write(std::span<const std::uint8_t> bytes, double now) noexcept = 0;

  /// Copies received bytes, without the converter's status bytes, oldest first; returns their number. Does not wait.
  /// Bytes that do not fit stay for the next call.
  virtual std::size_t read(std::span<std::uint8_t> buffer, double now) noexcept = 0;

  /// Unplugged permanently; a new transport is needed to find it again.
  virtual bool lost() const noexcept = 0;
};

}  // namespace presa::falcon
