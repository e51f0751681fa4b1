#pragma once
#include <cstdint>
#include <limits>

namespace presa {

/// What a driver's hardware can bear, and what a hand is to meet from it. It stands in the driver's code: no file can widen it (README.md
/// says who may set what). The default is careful: it holds for a driver that says nothing.
struct DeviceRating {
  double force = 5;                                             ///< nominal, for a short while [N]
  double force_rate = 1000;                                     ///< fastest change of the force [N/s]
  double continuous = std::numeric_limits<double>::infinity();  ///< for as long as one likes [N]; infinite: as `force`
  double heating_time = 60;                                     ///< time constant of the motors' heat [s]
  double speed = 1;                                             ///< at which the device must not push a hand on [m/s]
  double soft_start = 0.5;                                      ///< shortest way from zero to the full force [s]
  double watchdog = 0.1;  ///< oldest Object State that a force may be made from [s]: two periods at 20 Hz
  enum class Behind : std::uint8_t {
    kMotors,   ///< a hand may be held by them
    kModel,    ///< of motors: limited as they are, unless a study wants to see them overloaded
    kNothing,  ///< the finger is imagined
  };
  Behind behind = Behind::kMotors;

  /// The slowest way from any force to zero [s]. With the 5 ms for which a supervisor holds a dead program's last command, two more
  /// for its being late, and a cycle, a force is gone 20 ms after whatever happened.
  static constexpr double kSlowestDecay = 0.012;
};

/// Of fingers that only a computer moves: generous, and finite, so that nothing overflows.
inline constexpr DeviceRating kImaginedRating{
    .force = 1000, .force_rate = 1e6, .speed = 1000, .watchdog = 10, .behind = DeviceRating::Behind::kNothing};

/// All of it is finite and more than zero (`continuous` may be infinite), and zero is reached in time from any force.
constexpr bool isSound(const DeviceRating& rating) noexcept {
  const auto good = [](double value) { return value > 0 && value <= std::numeric_limits<double>::max(); };
  return good(rating.force) && good(rating.force_rate) && rating.continuous > 0 && good(rating.heating_time) &&
         good(rating.speed) && good(rating.soft_start) && good(rating.watchdog) &&
         rating.force / rating.force_rate <= DeviceRating::kSlowestDecay;
}
static_assert(isSound(DeviceRating{}) && isSound(kImaginedRating));

}  // namespace presa
