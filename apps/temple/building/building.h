#pragma once
#include <cstdint>

#include "apps/temple/building/block.h"
#include "apps/temple/building/proportions.h"

namespace presa::temple {

/// All blocks at their goal poses, on the ground z = 0, the front towards -y, centred at x = 0 and y = `behind` [m].
/// `seed` determines the chips. Every mesh is closed and welded. Results are bit-identical for the same arguments.
/// Thread: loading.
Building makeBuilding(const Proportions& proportions, double behind, std::uint64_t seed);

}  // namespace presa::temple
