#pragma once
#include <array>
#include <optional>

#include "devices/hand/hand.h"
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
/// finger asks for it, under what both feel. Thread: haptic; nonblocking.
class Pair {
 public:
  enum Side : std::size_t { kThumb, kIndex };  ///< thumb at the negative end of the line between them
  static constexpr double kSpeed = 0.5;        ///< max speed of the hand [m/s]
  static constexpr double kTurn = 3;           ///< [rad/s]
  static constexpr double kClose = 0.15;       ///< max speed of each fingertip relative to the hand [m/s]
  static constexpr double kArrive = 0.05;      ///< time constant of the followers [s]

  explicit Pair(const PairSettings& settings);
  /// Adds a finger of this stiffness [N/m]; false when that side is taken.
  bool add(Side side, double stiffness);
  Vec3 start(Side side) const noexcept;  ///< fingertip at time 0
  const PairSettings& settings() const noexcept { return settings_; }

  void point(const PointerState& pointer) noexcept;
  void feel(Side side, const Fingertip& tip) noexcept { fingers_[side]->tip = tip; }
  /// Hand::live of that finger.
  const HandPush& live(Side side, const Tick& tick) noexcept;

 private:
  struct DrivenFinger {
    Fingertip tip;
    HandPush push;
  };
  void plan(double period) noexcept;
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
  std::uint64_t planned_ = 0;  // ticks so far
};

}  // namespace presa::pointer
