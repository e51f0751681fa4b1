#pragma once
#include <memory>
#include <string>
#include <vector>

#include "devices/hand/motion.h"
#include "framework/device/device_settings.h"
#include "framework/scene/world.h"

namespace presa {

struct HandSettings {
  std::unique_ptr<Motion> motion;
  FingerImpedance impedance;       ///< with the chosen damping
  double lost_at = 0;              ///< the device delivers no sample from this time on [s]; infinity: never
  std::vector<std::string> notes;  ///< the damping, and the min damping for the contacts
};
/// -1 for the thumb, 1 otherwise; the setting 'side' overrides it (E404).
double sideOf(const DeviceBinding& binding, Diagnostics& diagnostics);
/// A setting as numbers, up to the first word that is none; empty where it is missing.
std::vector<double> settingNumbers(const DeviceBinding& binding, const std::string& key);
/// Fingertip radius of the role [m]; 0 when the scene has no such role.
double fingertipOf(const DeviceBinding& binding, const World& world);
/// Reads mass, stiffness and damping of a hand without a motion file, with defaults from `impedance`; motion stays
/// null.
HandSettings readImpedance(const DeviceBinding& binding, const World& world, double carried, FingerImpedance impedance,
                           Diagnostics& diagnostics);
/// Reads all settings. Findings go to `diagnostics` (E402 to E404 and those of the motion file); motion is null on
/// errors. `carried`: mass of the device that moves with the fingertip, used for the min damping of the contacts [kg].
HandSettings readHand(const DeviceBinding& binding, const World& world, double carried, Diagnostics& diagnostics);

}  // namespace presa
