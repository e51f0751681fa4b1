#include "experiments/stability/cases.h"

namespace presa::stability {

std::vector<Case> allCases() { return {graspInAir(), massRatio(), blockTower(), freeRotation()}; }

}  // namespace presa::stability
