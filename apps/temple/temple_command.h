#pragma once
#include "apps/common/options/command_line.h"

namespace presa {

/// Adds the command `presa temple`.
void addTemple(Command app, int& status);

}  // namespace presa
