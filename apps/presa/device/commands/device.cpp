#include "apps/presa/device/commands/device_commands.h"

namespace presa {

void addDevice(Command app, int& status) {
  Command command = app.command("device", "Haptic devices: what they are and what they can do");
  command.needCommand();
  addDeviceList(command, status);
  addDeviceCheck(command, status);
  addDeviceDoctor(command, status);
  addCharacterise(command, status);
  addCalibrate(command, status);
}

}  // namespace presa
