#include "apps/studies/faults/periods.h"

#include <memory>

#include "apps/studies/faults/fault_commands.h"

namespace presa {

void addPeriods(Command app, int& status) {
  auto options = std::make_shared<device::PeriodsOptions>();
  Command command =
      app.command("periods", "How much the load of one scene lengthens the haptic period, compared with another scene");
  command.option("FIRST", options->scenes[0], "scene").required().existingFile();
  command.option("SECOND", options->scenes[1], "scene that is compared with it").required().existingFile();
  command.option("--runs", options->runs, "of each, in turn").withinCount(1, 100000).showDefault();
  command.option("--for", options->seconds, "seconds of each run").positive().showDefault();
  command.option("--seed", options->seed, "of the bootstrap").showDefault();
  command.option("--out", options->out, "folder for periods.json");
  command.footer(
      "Run nothing else on the machine: its delays are what is measured. Exit status: 0 compared, 2 bad input, 130 "
      "Ctrl-C.\n"
      "Example:  presa device periods experiments/faults/hold.xml experiments/faults/stack.xml --runs 100");
  command.action([options, &status] { status = device::comparePeriods(*options); });
}

}  // namespace presa
