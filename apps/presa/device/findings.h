#pragma once
#include <string>
#include <vector>

#include "framework/device/device_plugin.h"

namespace presa::device {

/// Findings about one driver and its hardware.
struct Report {
  std::string name;     ///< name of the driver, or "this computer"
  std::string summary;  ///< summary of the driver; for a device of a rig, its role
  std::vector<DeviceFinding> findings;
};

/// Drivers that are installed with this program.
std::vector<std::string> drivers();

/// Calls diagnose() of the binding's driver. A driver that cannot be loaded is a finding, too.
Report ask(const DeviceBinding& binding);

bool hasProblem(const std::vector<Report>& reports);
std::string text(const std::vector<Report>& reports, bool color);
std::string json(const std::vector<Report>& reports);

}  // namespace presa::device
