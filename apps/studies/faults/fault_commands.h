#pragma once
#include "apps/common/options/command_line.h"

namespace presa {

/// Add the commands `presa device faults` and `presa device periods`.
void addFaults(Command device, int& status);
void addPeriods(Command device, int& status);

}  // namespace presa
