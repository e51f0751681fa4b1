#pragma once
#include "experiments/stability/case.h"

/// One function per file under cases/.
namespace presa::stability {

Case graspInAir();
Case massRatio();
Case blockTower();
Case freeRotation();

}  // namespace presa::stability
