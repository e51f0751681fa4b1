#include <memory>

#include "apps/presa/commands/commands.h"
#include "apps/presa/run/run_scene.h"

namespace presa {

void addRun(Command app, int& status) {
  auto a = std::make_shared<RunArguments>();
  a->options.duration = 0;
  Command command = app.command("run", "Run a scene, live or as fast as the machine goes");
  command.option("SCENE", a->inputs.scene, "scene file, e.g. config/scenes/cube.xml").required();
  addRunOptions(command, *a);
  command.footer(
      "Exit status: 0 no fault, 1 fault while running, 2 bad input (nothing written), 130 Ctrl-C.\n"
      "Example:  presa run config/scenes/cube.xml --lockstep --set body/cube/physics/mass=0.5 --report out.html");
  command.action([a, &status] { status = runScene(*a).status; });
}

}  // namespace presa
