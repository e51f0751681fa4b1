#pragma once
#include "apps/common/options/command_line.h"

namespace presa {

/// Adds `presa temple trials`, which stores its exit status in `status`.
void addTrials(Command app, int& status);

}  // namespace presa
