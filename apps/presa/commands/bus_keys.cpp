#include <cstdio>
#include <memory>
#include <string>

#include "apps/presa/commands/commands.h"
#include "framework/bus/bus_keys.h"

namespace presa {

void addBusKeys(Command app, int& status) {
  auto folder = std::make_shared<std::string>();
  Command command = app.command("keys", "Make certificates, so that only programs that have one can use the bus");
  command.option("DIR", *folder, "a folder that does not exist yet").required();
  command.footer(
      "Makes DIR/run, DIR/viewer, DIR/guide and DIR/commander: take each to the machine that plays that part, and name "
      "it there with\n"
      "--bus-keys. Programs without a certificate can neither join, nor read, nor forge; a viewer cannot command. "
      "DIR/authority "
      "has\n"
      "the key that signed them: keep it off the network, or delete it. Commands on lan need keys.\n"
      "Example:  presa bus keys lab\n"
      "          presa run config/scenes/cube.xml --bus lan --bus-commands --bus-keys lab/run\n"
      "          presa bus set material/rubber/stiffness=500 --bus lan --bus-keys lab/commander");
  command.action([=, &status] {
    bus::makeKeys(*folder);
    const char* dir = folder->c_str();
    std::printf("%s/run, %s/viewer, %s/guide, %s/commander: valid for ten years; the key in %s/authority signed them\n",
                dir, dir, dir, dir, dir);
    status = kExitOk;
  });
}

}  // namespace presa
