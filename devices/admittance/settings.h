#pragma once
#include "devices/admittance/drive.h"
#include "devices/hand/hand_settings.h"

namespace presa::admittance {

struct Settings {
  Parameters parameters;
  HandSettings hand;         ///< its motion is null on errors
  double stiffest_wall = 0;  ///< [N/m]
  std::uint64_t seed = 1;    ///< of the sensor's noise
};

/// Reads the rig settings of device and hand; findings go to `diagnostics` (those of the hand, E401, E450 to E453).
Settings readSettings(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics);

}  // namespace presa::admittance
