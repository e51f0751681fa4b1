#pragma once
#include <array>
#include <cstdint>

#include "framework/core/math/spatial.h"
#include "framework/core/state/limits.h"

namespace presa {

/// One haptic interface point (HIP) as its device reports it.
struct FingerInput {
  Vec3 p_WH = Vec3::Zero();      ///< position of the fingertip centre [m]
  Vec3 v_WH = Vec3::Zero();      ///< velocity [m/s]
  std::int32_t phase = -1;       ///< phase of a scripted motion, index into Device::phases(); -1: none
  bool valid = false;            ///< the sample of this tick is usable
  double age = 0;                ///< time since the device measured the sample [s]
  bool lost = false;             ///< device disconnected or reporting implausible samples: no force until a re-arm
  std::uint32_t buttons = 0;     ///< pressed buttons; bit 0: the participant's "ready" or answer, others by the device
  bool oriented = false;         ///< the device measures the orientation; false: q_WT is the identity
  Quat q_WT = Quat::Identity();  ///< orientation of the tool frame T, whose origin is H
  Vec3 w_WT = Vec3::Zero();      ///< angular velocity [rad/s]
};

/// Device State: the samples of all devices in one haptic tick, after the checks of SampleCheck.
/// Written by: haptic thread (device input). Order: the order of the roles in the scene.
struct DeviceState {
  double time = 0;              ///< simulated time of the sample [s]
  std::int32_t count = 0;       ///< fingers in use
  bool stop_requested = false;  ///< the run is being stopped: forces fade
  std::uint32_t rearms = 0;     ///< number of re-arms since the start; each one clears latched faults
  std::array<FingerInput, kMaxFingers> fingers;
};

/// Wrenches that go to the devices, after the output stage. Written by: haptic thread (device output).
struct ForceCommand {
  double time = 0;                      ///< [s]
  std::int32_t count = 0;               ///< fingers in use
  std::uint32_t status = 0;             ///< OutputStatus bits of all fingers together
  std::array<Vec3, kMaxFingers> f_H_W;  ///< force that each device holds from this tick on [N]
  std::array<Vec3, kMaxFingers> t_H_W;  ///< torque about H that it holds [N m]
};

}  // namespace presa
