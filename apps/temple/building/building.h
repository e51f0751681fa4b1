#pragma once
#include <cstdint>

#include "apps/temple/building/block.h"
#include "apps/temple/building/proportions.h"

namespace presa::temple {

/// All blocks at the places where they belong, on the ground z = 0, the front towards -y, centred at x = 0 and y = `behind` [m].
/// `seed` chooses where stone has broken off. Every mesh is closed and welded. The same arguments give the same bits.
/// Thread: loading.
Building makeBuilding(const Proportions& proportions, double behind, std::uint64_t seed);

}  // namespace presa::temple
