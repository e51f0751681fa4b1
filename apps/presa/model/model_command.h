#pragma once
#include "apps/common/options/command_line.h"

namespace presa {

/// Adds `presa model`, which stores its exit status in `status`.
void addModel(Command app, int& status);

}  // namespace presa
