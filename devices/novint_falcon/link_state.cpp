#include "devices/novint_falcon/link_state.h"

namespace presa::falcon {

const char* describe(LinkFault fault) noexcept {
  switch (fault) {
    case LinkFault::kNone:
      return "no fault";
    case LinkFault::kLost:
      return "the device was unplugged";
    case LinkFault::kControlRefused:
      return "the USB converter of the device refused a setting";
    case LinkFault::kNoFirmware:
      return "the device has no firmware yet, and the rig names none";
    case LinkFault::kNoLoader:
      return "neither the firmware nor the boot loader of the device answers";
    case LinkFault::kEchoMissing:
      return "the boot loader stopped echoing the firmware";
    case LinkFault::kEchoMismatch:
      return "the boot loader echoed something else than the firmware";
    case LinkFault::kFirmwareSilent:
      return "the firmware was loaded but does not answer";
    case LinkFault::kHomingLost:
      return "an encoder lost its reference; the force is zero";
    case LinkFault::kBadSamples:
      return "two impossible positions in a row (too far for a hand's motion); the force is zero";
  }
  return "unknown fault";
}

const char* remedy(LinkFault fault) noexcept {
  switch (fault) {
    case LinkFault::kNone:
      return "";
    case LinkFault::kLost:
      return "plug it in again, then open it again";
    case LinkFault::kControlRefused:
      return "unplug the device, wait a few seconds, plug it in again";
    case LinkFault::kNoFirmware:
      return "add <set key=\"firmware\" value=\"FILE.bin\"/>; Presa may not include that file";
    case LinkFault::kNoLoader:
      return "is its own power supply connected? Switch it off and on again";
    case LinkFault::kEchoMissing:
    case LinkFault::kEchoMismatch:
      return "check its power supply, and plug it into the computer itself, not into a hub";
    case LinkFault::kFirmwareSilent:
      return "is this the right firmware? Switch the device off and on again";
    case LinkFault::kHomingLost:
      return "pull the grip all the way out and push it in again";
    case LinkFault::kBadSamples:
      return "check the cable, then arm the device again";
  }
  return "";
}

}  // namespace presa::falcon
