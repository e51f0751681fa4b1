#include "experiments/stability/cases.h"

namespace presa::stability {

std::vector<Case> allCases() { return {graspInAir()}; }

}  // namespace presa::stability
