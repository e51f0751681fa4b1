#include "apps/presa/device/characterise.h"

#include <memory>

#include "apps/presa/device/commands/device_commands.h"

namespace presa {

void addCharacterise(Command app, int& status) {
  auto options = std::make_shared<device::CharacteriseOptions>();
  Command command = app.command(
      "characterise",
      "Resolution, workspace, forces, stiffness and bandwidth of a driver, beside the published figures of the device");
  command.option("DRIVER", options->driver, "folder under devices/, e.g. percro_arm").required();
  command.option("--out", options->out, "folder for report.html and characteristics.json");
  command.option("--format", options->format, "text or json").oneOf({"text", "json"});
  command.footer(
      "Exit status: 0 every figure agrees with the printed one, 1 some do not, 2 bad input.\n"
      "Example:  presa device characterise percro_arm --out out/percro");
  command.action([options, &status] { status = device::characterise(*options); });
}

}  // namespace presa
