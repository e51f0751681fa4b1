#pragma once
#include "experiments/stability/case.h"

/// One function per file under cases/.
namespace presa::stability {

Case graspInAir();

}  // namespace presa::stability
