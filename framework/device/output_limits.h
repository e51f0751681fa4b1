#pragma once
#include <limits>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/device/device_rating.h"
#include "framework/scene/ages.h"
#include "framework/scene/scene.h"

namespace presa {

/// Limits that the output stage of one tool enforces.
struct OutputLimits {
  double force = 8;          ///< magnitude [N]
  double force_rate = 1000;  ///< slew [N/s]
  double soft_start = 0.5;   ///< from zero to full force at start, after a watchdog and after a re-arm [s]
  double fade_out = 0.02;    ///< from full force to zero [s]
  double continuous = std::numeric_limits<double>::infinity();         ///< force for unlimited time [N]
  double heating_time = 60;                                            ///< time constant of the motors' heat [s]
  bool records_overload = false;                                       ///< a force above `continuous` is only reported
  double speed = std::numeric_limits<double>::infinity();              ///< over-speed trip [m/s]
  bool passivity = false;                                              ///< the hand may receive no net energy
  double torque = 0;                                                   ///< magnitude [N m]; 0: no torque is sent
  double torque_rate = 0;                                              ///< slew [N m/s]
  double continuous_torque = std::numeric_limits<double>::infinity();  ///< torque for unlimited time [N m]
  double angular_speed = std::numeric_limits<double>::infinity();      ///< over-speed trip [rad/s]
};

/// Limits of one finger's output stage, and the age from which it no longer trusts the dynamics.
struct FingerSafety {
  OutputLimits limits;             ///< for its OutputStage
  double watchdog = ages::kFloor;  ///< age of the Object State at which the force fades [s]
};

/// The limits of the rating alone, for code that enforces it independently of scene and rig (supervisor, transport
/// watch).
OutputLimits limitsOf(const DeviceRating& rating) noexcept;

/// The limits of one finger: for each, the smallest of the scene's wish, the rig's limit and the device's rating. If
/// the rig sets no force limit, motors and models get half of their nominal force. The slew limit is raised if zero
/// would take longer than DeviceRating::kSlowestDecay. Reports W650 to W654 to `findings` for values beyond the rating,
/// and appends a note for every limit that was lowered to `notes`. Thread: main.
FingerSafety safetyFor(const DeviceRole& wanted, const DeviceBinding& bound, const DeviceRating& rating,
                       std::vector<std::string>& notes, Diagnostics& findings);

}  // namespace presa
