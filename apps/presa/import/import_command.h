#pragma once
#include "apps/common/options/command_line.h"

namespace presa {

/// Adds `presa import`, which stores its exit status in `status`.
void addImport(Command app, int& status);

}  // namespace presa
