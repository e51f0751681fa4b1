#pragma once
#include "apps/common/options/command_line.h"

namespace presa {

/// Adds the command `presa lectures`.
void addLectures(Command app, int& status);

}  // namespace presa
