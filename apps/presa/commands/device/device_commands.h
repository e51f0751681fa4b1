#pragma once
#include "apps/presa/commands/commands.h"

namespace presa {

/// `presa device …`, one per subcommand.
void addCharacterise(CLI::App& app, int& status);
void addCalibrate(CLI::App& app, int& status);

}  // namespace presa
