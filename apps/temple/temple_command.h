#pragma once
#include "apps/common/options/command_line.h"

namespace presa {

/// `presa temple`.
void addTemple(Command app, int& status);

}  // namespace presa
