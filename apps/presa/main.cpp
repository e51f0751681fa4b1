#include "apps/common/options/program.h"
#include "apps/presa/commands/commands.h"

int main(int argc, char** argv) {
  const presa::Program program{
      .words = {},
      .declare =
          [](presa::Command app, int& status) {
            presa::addRun(app, status);
            presa::addGallery(app, status);
            presa::addCheck(app, status);
            presa::addExplain(app, status);
            presa::addPlugins(app, status);
            presa::addSchema(app, status);
            presa::addNew(app, status);
            presa::addReplay(app, status);
            presa::addView(app, status);
            presa::addBus(app, status);
          },
      .footer =
          "First steps:\n"
          "  presa run config/scenes/cube.xml                      two fingers lift a cube, live\n"
          "  presa run config/scenes/cube.xml --lockstep --report cube.html\n"
          "  presa gallery                                         all shipped scenes, and what each shows\n"
          "  presa explain config/scenes/cube.xml                  which parts run, and why\n"
          "  presa cost config/scenes/cube.xml --quick             what accuracy costs in time\n"
          "  presa COMMAND --help                                  all options of a command\n"
          "Exit status: 0 done, 1 it did not end well, 2 bad input and nothing was run, 3 no run on the bus, 130 "
          "Ctrl-C;\n"
          "docs/exit_status.md has those of every command."};
  return presa::runProgram(argc, argv, program);
}
