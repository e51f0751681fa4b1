#pragma once
#include "apps/common/options/command_line.h"

namespace presa {

/// Adds the command `presa stability`.
void addStability(Command app, int& status);

}  // namespace presa
