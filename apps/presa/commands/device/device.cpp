#include "apps/presa/commands/device/device_commands.h"

namespace presa {

void addDevice(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("device", "Haptic devices: what they are and what they can do");
  command->require_subcommand(1);
  addDeviceList(*command, status);
  addDeviceCheck(*command, status);
  addDeviceDoctor(*command, status);
  addCharacterise(*command, status);
  addCalibrate(*command, status);
  addFaults(*command, status);
  addPeriods(*command, status);
}

}  // namespace presa
