#pragma once
#include <cstddef>
#include <cstdint>

namespace presa::falcon {

enum class LinkState : std::uint8_t {
  kClosed,     ///< nothing was sent yet
  kStarting,   ///< asking for firmware, loading it where there is none
  kHoming,     ///< waiting until the user has moved the grip past all references; zero force
  kOperating,  ///< forces go out
  kLatched,    ///< a fault in operation: zero force until it is armed again
  kReleased,   ///< zero force until the end
  kDead,       ///< could not be started, or is gone: nothing is sent any more
};

enum class LinkFault : std::uint8_t {
  kNone,
  kLost,            ///< unplugged
  kControlRefused,  ///< the USB converter refused a setting
  kNoFirmware,      ///< does not answer, and there is no firmware to give it
  kNoLoader,        ///< neither firmware nor its boot loader answers
  kEchoMissing,     ///< the loader stopped echoing the firmware
  kEchoMismatch,    ///< the loader echoed something else
  kFirmwareSilent,  ///< the firmware was loaded, and does not answer
  kHomingLost,      ///< an encoder lost its reference in operation
  kBadSamples,      ///< two samples in a row that no hand can have moved to
};

/// How the last loading went, for a message.
struct LoadReport {
  int attempts = 0;           ///< that failed
  std::size_t bytes = 0;      ///< of the firmware, echoed right in the last attempt
  std::uint8_t expected = 0;  ///< kEchoMismatch: the next byte
  std::uint8_t found = 0;     ///< kEchoMismatch: what came instead
};

/// One line, without a full stop: "the device was unplugged".
const char* describe(LinkFault fault) noexcept;
/// What to do about it; "" when there is nothing to say.
const char* remedy(LinkFault fault) noexcept;

}  // namespace presa::falcon
