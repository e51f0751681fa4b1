#pragma once
#include <array>
#include <optional>

#include "devices/pointer/follower.h"
#include "devices/hand/finger_plant.h"
#include "framework/core/schedule/tick.h"
#include "framework/device/pointer_state.h"

namespace presa::pointer {

struct PairSettings {
  Vec3 start = Vec3::Zero();  ///< middle between the fingertips at the start [m]
  double fingertip = 0;       ///< radius of the larger one [m]
  double span = 0;            ///< free width between the open fingertips [m]
  double grip = 0;            ///< most that they press towards each other [N]
  double push = 0;            ///< most that each of them pushes in the hand's way [N]

  bool operator==(const PairSettings&) const = default;
};

/// Thumb and index on the springs of one hand, which goes where a pointer says. The hand is slow (`Follower`), its springs yield
/// to what the fingertips meet, and towards each other they press with a bounded force, however far they are told to close. Each tick
/// is lived once, by whichever finger asks first, under the forces that both held. Thread: haptic; nonblocking.
class Pair {
 public:
  enum Side : std::size_t { kThumb, kIndex };  ///< thumb at the negative end of the line between them
  static constexpr double kSpeed = 0.5;        ///< of the hand, at most [m/s]
  static constexpr double kTurn = 3;           ///< [rad/s]
  static constexpr double kClose = 0.15;       ///< of each fingertip against the hand [m/s]
  static constexpr double kArrive = 0.05;      ///< [s]

  explicit Pair(const PairSettings& settings);
  /// False when that side is taken.
  bool add(Side side, const FingerImpedance& impedance, double period);
  const PairSettings& settings() const noexcept { return settings_; }

  void point(const PointerState& pointer) noexcept;
  /// Up to this tick.
  void advance(const Tick& tick) noexcept;
  /// Force that the device holds against the finger from now on [N].
  void push(Side side, const Vec3& f_H_W) noexcept { fingers_[side]->felt = f_H_W; }
  const FingerPlant& finger(Side side) const noexcept { return fingers_[side]->plant; }

 private:
  struct Finger {
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
  std::array<std::optional<Finger>, 2> fingers_;
  double stiffness_ = 0;  // of the softer finger [N/m]
  Vec3 wanted_;
  double wanted_yaw_ = 0, closing_ = 0;
  Follower<Vec3> centre_;
  Follower<double> yaw_, half_;
  Tick at_;
};

}  // namespace presa::pointer
