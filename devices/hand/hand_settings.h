#pragma once
#include <memory>
#include <string>
#include <vector>

#include "devices/hand/motion.h"
#include "framework/scene/world.h"

namespace presa {

/// The settings by which a rig describes a simulated hand: motion, side, mass, stiffness, damping, lost_at.
const std::vector<std::string>& handKeys();

/// A setting that the driver does not know is an error E401.
void refuseUnknownSettings(const DeviceBinding& binding, const std::vector<std::string>& known,
                           Diagnostics& diagnostics);

/// A setting that is a positive number (E403), or `fallback` where the rig says nothing.
double positiveSetting(const DeviceBinding& binding, const std::string& key, double fallback, Diagnostics& diagnostics);

struct HandSettings {
  std::unique_ptr<Motion> motion;
  FingerImpedance impedance;       ///< damping chosen
  double lost_at = 0;              ///< from then on the device gives no sample [s]; infinity: never
  std::vector<std::string> notes;  ///< the damping, and what the contacts ask for
};
/// -1 for the thumb, 1 otherwise, unless the setting 'side' says it (E404).
double sideOf(const DeviceBinding& binding, Diagnostics& diagnostics);
/// Radius of the role's fingertip [m]; 0 where the scene has no such role.
double fingertipOf(const DeviceBinding& binding, const World& world);
/// The same for a hand that moves by itself: mass, stiffness and damping alone, onto those of `impedance`; motion stays null.
HandSettings readImpedance(const DeviceBinding& binding, const World& world, double carried, FingerImpedance impedance,
                           Diagnostics& diagnostics);
/// Reads them; all findings go to `diagnostics` (E402 to E404 and those of the motion's file), motion is null when any is an
/// error. `carried`: mass of a device that moves with the fingertip, for the damping that contacts ask for [kg].
HandSettings readHand(const DeviceBinding& binding, const World& world, double carried, Diagnostics& diagnostics);

}  // namespace presa
