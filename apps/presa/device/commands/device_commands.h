#pragma once
#include "apps/common/exit_status.h"
#include "apps/common/options/command_line.h"

namespace presa {

/// `presa device`. Each function adds commands, which store their exit status in `status`.
void addDevice(Command app, int& status);
void addDeviceList(Command app, int& status);
void addDeviceCheck(Command app, int& status);
void addDeviceDoctor(Command app, int& status);
void addCharacterise(Command app, int& status);
void addCalibrate(Command app, int& status);

}  // namespace presa
