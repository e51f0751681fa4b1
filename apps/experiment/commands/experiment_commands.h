#pragma once
#include <string>

#include "apps/common/exit_status.h"
#include "apps/common/options/command_line.h"

namespace presa {

/// Adds the command `presa experiment`.
void addExperiment(Command app, int& status);

/// Its subcommands, grouped by the object that they work on.
void addSessionCommands(Command app, int& status);  ///< dry-run, run, resume
void addDatasetCommands(Command app, int& status);  ///< validate, key, sign, forget
void addExport(Command app, int& status);
void addAnalyse(Command app, int& status);
void addSimulate(Command app, int& status);

/// Adds the positional argument DIR.
void addFolder(Command command, std::string& folder);

}  // namespace presa
