#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "devices/novint_falcon/link.h"
#include "framework/scene/run_options.h"

namespace presa::falcon {

/// The rig settings of a Falcon.
struct FalconSettings {
  std::string role, serial;            ///< serial number or port; empty: the only device
  SourceLocation where;                ///< of the device in the rig
  std::vector<std::uint8_t> firmware;  ///< empty: the firmware is already running
  Pose X_WD;                           ///< the device's frame D (kinematics.h) in the world
  double scale = 1;                    ///< metres in the world per metre of the grip
  double homing_wait = 15;             ///< max time for the user to home the grip in open() [s]
  bool realtime = false;
  LinkSettings link;
};

/// Reads the settings; findings go to `diagnostics`.
FalconSettings readSettings(const DeviceBinding& binding, const RunOptions& options, Diagnostics& diagnostics);

}  // namespace presa::falcon
