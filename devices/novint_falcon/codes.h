#pragma once
#include "devices/novint_falcon/link_state.h"
#include "devices/novint_falcon/usb_bus.h"

namespace presa::falcon {

/// Numbers of the findings about a Falcon (E4xx: rigs and devices).
enum Code : int {
  kBadNumber = 470,
  kFirmwareUnreadable = 471,
  kFirmwareEmpty = 472,
  kFirmwareTooLarge = 473,
  kFirmwareForeign = 474,  ///< does not begin as firmware does
  kFirmwareUnknown = 475,  ///< W: begins right, but is none of the known files
  kNeedsRealTime = 476,
  kNoFalcon = 477,
  kWhichFalcon = 478,
  kMayNotOpen = 479,
  kHeld = 480,
  kUsbFails = 481,
  kNoFirmwareNamed = 482,
  kLoaderSilent = 483,
  kEchoWrong = 484,
  kFirmwareDead = 485,
  kNotHomed = 486,
  kGone = 487,
};

Code codeOf(UsbProblem problem);
Code codeOf(LinkFault fault);

}  // namespace presa::falcon
