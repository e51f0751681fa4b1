#pragma once
#include "apps/presa/commands/commands.h"

namespace presa {

/// `presa device …`, one per subcommand.
void addDeviceList(Command app, int& status);
void addDeviceCheck(Command app, int& status);
void addDeviceDoctor(Command app, int& status);
void addCharacterise(Command app, int& status);
void addCalibrate(Command app, int& status);

}  // namespace presa
