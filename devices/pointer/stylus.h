#pragma once
#include "devices/hand/finger_plant.h"
#include "devices/hand/turn_plant.h"
#include "devices/pointer/follower.h"
#include "framework/core/schedule/tick.h"
#include "framework/core/state/device_state.h"
#include "framework/device/pointer_state.h"

namespace presa::pointer {

/// A pen that follows a pointer: its tip the place, its axis the yaw and the tilt. It moves and turns with bounded speed
/// and acceleration, and yields to forces and torques. Thread: haptic; nonblocking.
class Stylus {
 public:
  static constexpr double kSpeed = 0.5;    ///< max speed of the tip [m/s]
  static constexpr double kTurn = 3;       ///< [rad/s]
  static constexpr double kArrive = 0.05;  ///< time constant of the followers [s]

  /// `push`: max force of the hand against an obstacle [N].
  Stylus(const Vec3& start, double push, const FingerImpedance& impedance, double period);

  void point(const PointerState& pointer) noexcept;
  /// Simulates up to this tick.
  void advance(const Tick& tick) noexcept;
  /// Wrench of the device on the tool, held until the next call.
  void push(const Wrench& F_H_W) noexcept { held_ = F_H_W; }
  FingerInput sample() const noexcept;

 private:
  Quat wantedOrientation() const noexcept;
  Vec3 wantedRate() const noexcept;

  double lead_;  // max distance of the hand before the tip: the force limit over the spring [m]
  FingerPlant tip_;
  TurnPlant turn_;
  Vec3 wanted_;
  double wanted_yaw_ = 0, wanted_tilt_ = 0;
  std::uint32_t buttons_ = 0;
  Follower<Vec3> place_;
  Follower<double> yaw_, tilt_;
  Wrench held_;
  Tick at_;
};

}  // namespace presa::pointer
