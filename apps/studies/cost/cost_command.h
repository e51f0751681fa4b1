#pragma once
#include "apps/common/options/command_line.h"

namespace presa {

/// Adds the command `presa cost`.
void addCost(Command app, int& status);

}  // namespace presa
