#pragma once
#include <string>
#include <vector>

#include "apps/presa/device/findings.h"

namespace presa::device {

/// What this computer refuses that real time and devices need: priority, locked memory, the group that may open devices, and
/// in `udev_folder` the rules of the drivers.
Report computer(const std::vector<std::string>& of_drivers, const std::string& udev_folder);

/// Writes the rule of every driver that has one to `udev_folder`; the files' names. Throws InputError E477 when that is not
/// allowed.
std::vector<std::string> installUdevRules(const std::vector<std::string>& of_drivers, const std::string& udev_folder);

}  // namespace presa::device
