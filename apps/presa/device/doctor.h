#pragma once
#include <string>
#include <vector>

#include "apps/presa/device/findings.h"

namespace presa::device {

/// Findings about the rights that real time and devices need: priority, locked memory, the group that may open devices,
/// and the drivers' rules in `udev_folder`.
Report computer(const std::vector<std::string>& of_drivers, const std::string& udev_folder);

/// Writes the rule of every driver that has one to `udev_folder`; returns the files' names. Throws InputError E477 when
/// this is not allowed.
std::vector<std::string> installUdevRules(const std::vector<std::string>& of_drivers, const std::string& udev_folder);

}  // namespace presa::device
