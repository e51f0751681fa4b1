#pragma once
#include "apps/common/options/command_line.h"

namespace presa {

/// Declares `presa printed`. `status`: exit status of its action.
void addPrinted(Command app, int& status);

}  // namespace presa
