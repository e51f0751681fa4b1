#pragma once
#include <cstdint>
#include <limits>

namespace presa {

/// Limits of a driver's hardware and of the forces that a hand may meet from it. They stand in the driver's code; scene
/// and rig can only tighten them (LIMITS.md lists who may set what). The careful defaults hold for a driver that states
/// no rating.
struct DeviceRating {
  double force = 5;                                             ///< nominal force, for a short time [N]
  double force_rate = 1000;                                     ///< fastest change of the force [N/s]
  double continuous = std::numeric_limits<double>::infinity();  ///< force for unlimited time [N]; infinite: `force`
  double heating_time = 60;                                     ///< time constant of the motors' heat [s]
  double speed = 1;                                             ///< no force may push a hand that is faster [m/s]
  double torque = 0;       ///< nominal torque, for a short time [N m]; 0: the device takes no torque
  double torque_rate = 0;  ///< fastest change of the torque [N m/s]
  double continuous_torque = std::numeric_limits<double>::infinity();  ///< torque for unlimited time [N m]
  double angular_speed = 20;  ///< no torque may push a hand that turns faster [rad/s]
  double soft_start = 0.5;    ///< shortest time from zero to the full force [s]
  double watchdog = 0.1;      ///< oldest Object State that a force may be computed from [s]: two periods at 20 Hz
  /// What produces the force.
  enum class Behind : std::uint8_t {
    kMotors,   ///< real motors, which may hold a hand
    kModel,    ///< a model of motors: same limits, unless a study records their overload
    kNothing,  ///< no motors: the finger is simulated
  };
  Behind behind = Behind::kMotors;  ///< kMotors unless the driver is a simulation

  /// Longest time that the slew limit may take from any force to zero [s]. A supervisor holds a dead program's last
  /// command for 5 ms; with 2 ms for delays and one cycle, the force is zero within 20 ms of any failure.
  static constexpr double kSlowestDecay = 0.012;
};

/// Rating of simulated fingers: generous, but finite, so that nothing overflows.
inline constexpr DeviceRating kImaginedRating{.force = 1000,
                                              .force_rate = 1e6,
                                              .speed = 1000,
                                              .torque = 10,
                                              .torque_rate = 1e4,
                                              .angular_speed = 1000,
                                              .watchdog = 10,
                                              .behind = DeviceRating::Behind::kNothing};

/// True if all values are finite (the continuous ones may be infinite) and above zero, and the slew limits take any
/// force and any torque to zero within kSlowestDecay. Without a torque, its other limits do not matter.
constexpr bool isSound(const DeviceRating& rating) noexcept {
  const auto good = [](double value) { return value > 0 && value <= std::numeric_limits<double>::max(); };
  const bool torque = good(rating.torque) && good(rating.torque_rate) && rating.continuous_torque > 0 &&
                      good(rating.angular_speed) && rating.torque / rating.torque_rate <= DeviceRating::kSlowestDecay;
  return (rating.torque == 0 || torque) && good(rating.force) && good(rating.force_rate) && rating.continuous > 0 &&
         good(rating.heating_time) && good(rating.speed) && good(rating.soft_start) && good(rating.watchdog) &&
         rating.force / rating.force_rate <= DeviceRating::kSlowestDecay;
}
static_assert(isSound(DeviceRating{}) && isSound(kImaginedRating));

}  // namespace presa
