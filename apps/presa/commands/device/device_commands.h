#pragma once
#include "apps/common/options/commands.h"

namespace presa {

/// `presa device …`, one per subcommand.
void addDeviceList(CLI::App& app, int& status);
void addDeviceCheck(CLI::App& app, int& status);
void addDeviceDoctor(CLI::App& app, int& status);
void addCharacterise(CLI::App& app, int& status);
void addCalibrate(CLI::App& app, int& status);
void addFaults(CLI::App& app, int& status);
void addPeriods(CLI::App& app, int& status);

}  // namespace presa
