#pragma once
#include "devices/novint_falcon/link_state.h"
#include "devices/novint_falcon/usb_bus.h"

namespace presa::falcon {

/// Error numbers of the Falcon driver (E4xx: rigs and devices).
enum Code : int {
  kUnevenReplies = 459,
  kBadNumber = 480,
  kFirmwareUnreadable = 481,
  kFirmwareEmpty = 482,
  kFirmwareTooLarge = 483,
  kFirmwareForeign = 484,  ///< does not begin like firmware
  kFirmwareUnknown = 485,  ///< warning: begins correctly, but is none of the known files
  kNeedsRealTime = 486,
  kNoFalcon = 487,
  kWhichFalcon = 488,
  kMayNotOpen = 489,
  kHeld = 490,
  kUsbFails = 491,
  kNoFirmwareNamed = 492,
  kLoaderSilent = 493,
  kEchoWrong = 494,
  kFirmwareDead = 495,
  kNotHomed = 496,
  kGone = 497,
};

Code codeOf(UsbProblem problem);
Code codeOf(LinkFault fault);

}  // namespace presa::falcon
