#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "framework/core/math/spatial.h"

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

/// Device State: the samples of all devices in one haptic tick, after the checks of SampleCheck. Sized by the scene at
/// load, one finger each role, in the order of the scene. Written by: haptic thread (device input).
struct DeviceState {
  double time = 0;                   ///< simulated time of the sample [s]
  bool stop_requested = false;       ///< the run is being stopped: forces fade
  std::uint32_t rearms = 0;          ///< number of re-arms since the start; each one clears latched faults
  std::vector<FingerInput> fingers;  ///< in the order of the scene's roles

  DeviceState() = default;                                                   ///< of no finger
  explicit DeviceState(std::size_t finger_count) : fingers(finger_count) {}  ///< as many as the scene has roles
  std::int32_t count() const noexcept { return static_cast<std::int32_t>(fingers.size()); }  ///< fingers
  /// Heap memory that it owns [bytes] (SizedAtLoad).
  std::size_t roomBytes() const noexcept { return fingers.capacity() * sizeof(FingerInput); }
};

/// Wrenches that go to the devices, after the output stage; sized as DeviceState. Written by: haptic thread (device
/// output).
struct ForceCommand {
  double time = 0;           ///< [s]
  std::uint32_t status = 0;  ///< OutputStatus bits of all fingers together
  std::vector<Vec3> f_H_W;   ///< force that each device holds from this tick on [N]
  std::vector<Vec3> t_H_W;   ///< torque about H that it holds [N m]

  ForceCommand() = default;  ///< to no finger
  /// Zero force and torque on each finger.
  explicit ForceCommand(std::size_t finger_count)
      : f_H_W(finger_count, Vec3::Zero()), t_H_W(finger_count, Vec3::Zero()) {}
  std::int32_t count() const noexcept { return static_cast<std::int32_t>(f_H_W.size()); }  ///< fingers
  /// Heap memory that it owns [bytes] (SizedAtLoad).
  std::size_t roomBytes() const noexcept { return (f_H_W.capacity() + t_H_W.capacity()) * sizeof(Vec3); }
};

}  // namespace presa
