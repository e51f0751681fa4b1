#pragma once
#include <array>
#include <cstdint>

#include "devices/hand/hand.h"

namespace presa::linking {

struct PairSettings {
  std::array<Vec3, 2> p_WD{Vec3::Zero(), Vec3::Zero()};  ///< bases: where the axes of each device meet [m]
  std::size_t leader = 1;                                ///< the device that the hand leads
  double link = 0.03;  ///< from a fingertip to the joint's centre, along the line from the base [m]
  double size = 0.08;  ///< of the path [m]
  std::uint64_t seed = 1;

  bool operator==(const PairSettings&) const = default;
};

/// Two fingertips whose devices a Cardan joint links, and a hand that leads one of them. The joint holds their centres
/// together: a spring and a damper that are held over a tick, stable for fingertips of 50 g and more at 1 kHz:
/// K T^2 / m = 0.8 and B T / m = 1.2 for the reduced mass m of 25 g, so that 1 - B T / m + K T^2 / 2 m < 1.
/// Frame W. Thread: haptic; nothing allocates.
class LinkedPair {
 public:
  static constexpr double kStiffness = 20e3;  ///< of the joint [N/m]
  static constexpr double kDamping = 30;      ///< [N s/m]
  static constexpr double kDuration = 20;     ///< the path repeats no earlier [s]
  static constexpr FingerImpedance kLeading{.mass = 0.1, .stiffness = 2000, .damping = 40};
  static constexpr FingerImpedance kLed{.mass = 0.05, .stiffness = 0, .damping = 0};

  explicit LinkedPair(const PairSettings& settings);
  const PairSettings& settings() const noexcept { return settings_; }

  Vec3 start(std::size_t device) const noexcept { return tipAt(device, 0); }
  void feel(std::size_t device, const Fingertip& tip) noexcept { tips_[device] = tip; }
  HandPush push(std::size_t device, const Tick& tick) noexcept;
  /// Fingertip of a device when the joint's centre is on the path.
  Vec3 tipAt(std::size_t device, double time) const noexcept;
  Vec3 centreAt(double time) const noexcept;
  /// Distance between the joint's centres by both fingertips [m].
  double gap() const noexcept { return (centreOf(0) - centreOf(1)).norm(); }

 private:
  Vec3 centreOf(std::size_t device) const noexcept;

  PairSettings settings_;
  Vec3 middle_, amplitude_, rate_, phase_;  // of the path [m], [Hz], [rad]
  std::array<Fingertip, 2> tips_;
  std::uint64_t held_for_ = UINT64_MAX;  // tick of `joint_`
  Vec3 joint_ = Vec3::Zero();            // force of the joint on the first fingertip [N]
};

}  // namespace presa::linking
