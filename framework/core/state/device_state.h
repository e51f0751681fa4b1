#pragma once
#include <array>
#include <cstdint>

#include "framework/core/math/spatial.h"
#include "framework/core/state/limits.h"

namespace presa {

/// One haptic interface point (HIP) as its device reports it.
struct FingerInput {
  Vec3 p_WH = Vec3::Zero();   ///< position of the fingertip centre [m]
  Vec3 v_WH = Vec3::Zero();   ///< velocity [m/s]
  std::int32_t phase = -1;    ///< phase of a scripted motion, index into Device::phases(); -1: none
  bool valid = false;         ///< the device delivered a usable sample this tick
  double age = 0;             ///< of the sample: since the device measured it [s]
  bool lost = false;          ///< gone, or not to be believed: no force until it is re-armed
  std::uint32_t buttons = 0;  ///< bit 0: the participant's "ready" or answer; others as the device counts them
};

/// Device State: everything that comes in from the devices in one haptic tick.
/// Written by: haptic thread (device input). Order: as the roles stand in the scene.
struct DeviceState {
  double time = 0;              ///< simulated time of the sample [s]
  std::int32_t count = 0;       ///< fingers in use
  bool stop_requested = false;  ///< the run is being stopped: forces fade
  std::uint32_t rearms = 0;     ///< how often somebody has looked and forgiven latched faults, since the start
  std::array<FingerInput, kMaxFingers> fingers;
};

/// Forces that really go to the devices, after the output stage.
struct ForceCommand {
  double time = 0;
  std::int32_t count = 0;
  std::uint32_t status = 0;             ///< OutputStatus bits of any finger
  std::array<Vec3, kMaxFingers> f_H_W;  ///< force that each device holds from this tick on [N]
};

}  // namespace presa
