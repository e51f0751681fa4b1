#pragma once
#include <limits>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/device/device_rating.h"
#include "framework/scene/ages.h"
#include "framework/scene/scene.h"

namespace presa {

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

/// What the output stage of one finger keeps to, and when it stops to trust the dynamics.
struct FingerSafety {
  OutputLimits limits;
  double watchdog = ages::kFloor;  ///< age of the Object State at which the force fades [s]
};

/// The rating alone: for those who hold it whatever a scene and a rig say.
OutputLimits limitsOf(const DeviceRating& rating) noexcept;

/// The smallest of what the scene wants, the rig allows and the device can bear. Where the rig says nothing, half of the nominal
/// force is allowed. The slew is never so slow that zero takes longer than DeviceRating::kSlowestDecay.
/// What is taken from a wish is said: to `findings` what goes past the rating (W650 to W654), to `notes` what one may wonder about.
FingerSafety safetyFor(const DeviceRole& wanted, const DeviceBinding& bound, const DeviceRating& rating,
                       std::vector<std::string>& notes, Diagnostics& findings);

}  // namespace presa
