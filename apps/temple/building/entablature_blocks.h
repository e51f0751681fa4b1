#pragma once
#include "apps/temple/building/block.h"
#include "apps/temple/building/proportions.h"
#include "framework/core/math/random.h"

namespace presa::temple {

/// Blocks above the columns in their own frames, without name and place. Lengths along x, in metres.
Block makeArchitrave(const Proportions& proportions, double length, RandomStream chips);
/// `half_metope`: what a corner block has of it beside its triglyph, at its left (negative) or right end; 0: none.
Block makeTriglyph(const Proportions& proportions, double half_metope, RandomStream chips);
Block makeMetope(const Proportions& proportions, RandomStream chips);
Block makeCornice(const Proportions& proportions, double length, RandomStream chips);
/// Half of the pediment: a wedge with a vertical end; heights at its left and right end.
Block makeTympanum(const Proportions& proportions, double length, double left, double right, RandomStream chips);
Block makeRakingCornice(const Proportions& proportions, double length, RandomStream chips);
Block makeTile(const Proportions& proportions, double length, RandomStream chips);

}  // namespace presa::temple
