#pragma once
#include <limits>
#include <string>
#include <vector>

#include "framework/scene/scene.h"

namespace presa {

/// What a driver's hardware can bear, and what a hand is to meet from it. Infinite: nothing known, nothing limited.
struct DeviceRating {
  double force = std::numeric_limits<double>::infinity();       ///< nominal, for a short while [N]
  double continuous = std::numeric_limits<double>::infinity();  ///< for as long as one likes [N]
  double heating_time = 60;                                     ///< time constant of the motors' heat [s]
  double speed = std::numeric_limits<double>::infinity();       ///< at which the device must not push a hand on [m/s]
};

/// What the output stage of one finger keeps to.
struct OutputLimits {
  double force = 8;          ///< magnitude [N]
  double force_rate = 1000;  ///< slew [N/s]
  double soft_start = 0.5;   ///< from zero to full force at start, after a watchdog and after a re-arm [s]
  double fade_out = 0.02;    ///< from full force to zero [s]
  double continuous = std::numeric_limits<double>::infinity();  ///< [N]
  double heating_time = 60;                                     ///< [s]
  bool records_overload = false;                                ///< past `continuous` is an event, not a limit
  double speed = std::numeric_limits<double>::infinity();       ///< [m/s]
  bool passivity = false;                                       ///< the hand may get no net energy
};

/// The smallest of what the scene wants, the rig allows and the device can bear. Where the rig says nothing, half of the nominal
/// force is allowed. What came of it that somebody may wonder about goes to `notes`.
OutputLimits limitsFor(const DeviceRole& wanted, const DeviceBinding::Limits& allowed, const DeviceRating& rating,
                       std::vector<std::string>& notes);

}  // namespace presa
