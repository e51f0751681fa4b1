#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "devices/novint_falcon/link.h"
#include "framework/scene/world.h"

namespace presa::falcon {

/// What a rig says of a Falcon.
struct FalconSettings {
  std::string role, serial;            ///< serial number or port; empty: there is only one
  SourceLocation where;                ///< of the device in the rig
  std::vector<std::uint8_t> firmware;  ///< empty: the device has its firmware already
  Pose X_WD;                           ///< the device's frame D (kinematics.h) in the world
  double scale = 1;                    ///< metres in the world for one of the grip
  double homing_wait = 15;             ///< how long open() waits for the user to home the grip [s]
  bool realtime = false;
  LinkSettings link;
};

/// All findings to `diagnostics`.
FalconSettings readSettings(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics);

}  // namespace presa::falcon
