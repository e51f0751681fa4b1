#pragma once
#include <array>
#include <optional>

#include "devices/hand/finger_plant.h"
#include "devices/pointer/follower.h"
#include "framework/core/schedule/tick.h"
#include "framework/device/pointer_state.h"

namespace presa::pointer {

struct PairSettings {
  Vec3 start = Vec3::Zero();  ///< initial midpoint between the fingertips [m]
  double fingertip = 0;       ///< radius of the larger one [m]
  double span = 0;            ///< free width between the open fingertips [m]
  double grip = 0;            ///< max force towards each other [N]
  double push = 0;            ///< max force of each finger in the hand's direction of motion [N]

  bool operator==(const PairSettings&) const = default;
};

/// Thumb and index on the springs of one hand that follows a pointer. The hand moves slowly (`Follower`), its springs
/// yield to obstacles, and the grip force is bounded for any closing. Each tick is simulated once, when the first
/// finger asks for it, under the forces on both. Thread: haptic; nonblocking.
class Pair {
 public:
  enum Side : std::size_t { kThumb, kIndex };  ///< thumb at the negative end of the line between them
  static constexpr double kSpeed = 0.5;        ///< max speed of the hand [m/s]
  static constexpr double kTurn = 3;           ///< [rad/s]
  static constexpr double kClose = 0.15;       ///< max speed of each fingertip relative to the hand [m/s]
  static constexpr double kArrive = 0.05;      ///< time constant of the followers [s]

  explicit Pair(const PairSettings& settings);
  /// Adds a finger; false when that side is taken.
  bool add(Side side, const FingerImpedance& impedance, double period);
  const PairSettings& settings() const noexcept { return settings_; }

  void point(const PointerState& pointer) noexcept;
  /// Simulates up to this tick.
  void advance(const Tick& tick) noexcept;
  /// Force of the device on the finger, held until the next call [N].
  void push(Side side, const Vec3& f_H_W) noexcept { fingers_[side]->felt = f_H_W; }
  const FingerPlant& finger(Side side) const noexcept { return fingers_[side]->plant; }

 private:
  struct DrivenFinger {
    FingerPlant plant;
    double stiffness;
    Vec3 felt = Vec3::Zero();
  };
  void live(double period) noexcept;
  bool holds(const Vec3& along) const noexcept;
  double halfWidth(const Vec3& along) const noexcept;
  Vec3 middle(const Vec3& along) const noexcept;
  double openHalf() const noexcept { return settings_.span / 2 + settings_.fingertip; }

  const PairSettings settings_;
  std::array<std::optional<DrivenFinger>, 2> fingers_;
  double stiffness_ = 0;  // of the softer finger [N/m]
  Vec3 wanted_;
  double wanted_yaw_ = 0, closing_ = 0;
  Follower<Vec3> centre_;
  Follower<double> yaw_, half_;
  Tick at_;
};

}  // namespace presa::pointer
