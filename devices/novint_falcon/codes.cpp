#include "devices/novint_falcon/codes.h"

namespace presa::falcon {

Code codeOf(UsbProblem problem) {
  switch (problem) {
    case UsbProblem::kNoUsb:
    case UsbProblem::kNoDevice:
      return kNoFalcon;
    case UsbProblem::kNotThisOne:
    case UsbProblem::kSeveral:
      return kWhichFalcon;
    case UsbProblem::kNoPermission:
      return kMayNotOpen;
    case UsbProblem::kKernelDriver:
    case UsbProblem::kBusy:
      return kHeld;
    case UsbProblem::kNone:
    case UsbProblem::kNoNode:
    case UsbProblem::kFailed:
      break;
  }
  return kUsbFails;
}

Code codeOf(LinkFault fault) {
  switch (fault) {
    case LinkFault::kNoFirmware:
      return kNoFirmwareNamed;
    case LinkFault::kNoLoader:
      return kLoaderSilent;
    case LinkFault::kEchoMissing:
    case LinkFault::kEchoMismatch:
      return kEchoWrong;
    case LinkFault::kFirmwareSilent:
      return kFirmwareDead;
    default:
      return kGone;
  }
}

}  // namespace presa::falcon
