#pragma once
#include <cstddef>
#include <cstdint>

namespace presa::falcon {

enum class LinkState : std::uint8_t {
  kClosed,     ///< no request sent yet
  kStarting,   ///< asking for firmware, loading it if there is none
  kHoming,     ///< waiting for the user to move the grip past all references; zero force
  kOperating,  ///< forces are sent
  kLatched,    ///< fault in operation: zero force until a re-arm
  kReleased,   ///< zero force until the end
  kDead,       ///< start-up failed, or the device is gone: no more requests
};

enum class LinkFault : std::uint8_t {
  kNone,
  kLost,            ///< unplugged
  kControlRefused,  ///< the USB converter refused a setting
  kNoFirmware,      ///< no answer, and no firmware to load
  kNoLoader,        ///< neither the firmware nor the boot loader answers
  kEchoMissing,     ///< the loader stopped echoing the firmware
  kEchoMismatch,    ///< the loader echoed a different byte
  kFirmwareSilent,  ///< the firmware was loaded but does not answer
  kHomingLost,      ///< an encoder lost its reference in operation
  kBadSamples,      ///< two consecutive samples with an impossible motion
};

/// Result of the last firmware upload, for a message.
struct LoadReport {
  int attempts = 0;           ///< failed attempts
  std::size_t bytes = 0;      ///< firmware bytes echoed correctly in the last attempt
  std::uint8_t expected = 0;  ///< kEchoMismatch: the expected byte
  std::uint8_t found = 0;     ///< kEchoMismatch: the received byte
};

/// One line, without a full stop: "the device was unplugged".
const char* describe(LinkFault fault) noexcept;
/// Advice for the user; "" without any.
const char* remedy(LinkFault fault) noexcept;

}  // namespace presa::falcon
