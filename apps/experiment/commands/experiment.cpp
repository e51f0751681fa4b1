#include "apps/experiment/commands/experiment_commands.h"

namespace presa {

void addFolder(Command command, std::string& folder) {
  command.option("DIR", folder, "folder of a dataset, or of one session in it").required().existingFolder();
}

void addExperiment(Command app, int& status) {
  Command command = app.command("experiment", "Psychophysics: from an experiment's definition to its data");
  command.needCommand();
  addSessionCommands(command, status);
  addSimulate(command, status);
  addDatasetCommands(command, status);
  addExport(command, status);
  addAnalyse(command, status);
}

}  // namespace presa
