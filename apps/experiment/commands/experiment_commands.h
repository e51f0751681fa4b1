#pragma once
#include <string>

#include "apps/common/options/commands.h"

namespace presa {

/// `presa experiment …`, by what it works on.
void addSessionCommands(CLI::App& app, int& status);  ///< dry-run, run, resume
void addDatasetCommands(CLI::App& app, int& status);  ///< validate, key, sign, forget
void addExport(CLI::App& app, int& status);
void addAnalyse(CLI::App& app, int& status);

void addSimulate(CLI::App& app, int& status);  ///< simulate

/// The argument DIR.
void addFolder(CLI::App& command, std::string& folder);

}  // namespace presa
