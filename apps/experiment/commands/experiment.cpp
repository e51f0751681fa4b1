#include "apps/experiment/commands/experiment_commands.h"

namespace presa {

void addFolder(CLI::App& command, std::string& folder) {
  command.add_option("DIR", folder, "folder of a dataset, or of one session in it")
      ->required()
      ->check(CLI::ExistingDirectory);
}

void addExperiment(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("experiment", "Psychophysics: from an experiment's definition to its data");
  command->require_subcommand(1);
  addSessionCommands(*command, status);
  addSimulate(*command, status);
  addDatasetCommands(*command, status);
  addExport(*command, status);
  addAnalyse(*command, status);
}

}  // namespace presa
