#pragma once
#include "apps/temple/building/block.h"
#include "apps/temple/building/proportions.h"
#include "framework/core/math/random.h"

namespace presa::temple {

/// Blocks above the columns, in their own frames, without name and pose. Lengths are along x, in metres.
Block makeArchitrave(const Proportions& proportions, double length, RandomStream chips);
/// `half_metope`: width of the half metope [m] that a corner block includes at its left (negative) or right (positive)
/// end; 0: none.
Block makeTriglyph(const Proportions& proportions, double half_metope, RandomStream chips);
Block makeMetope(const Proportions& proportions, RandomStream chips);
Block makeCornice(const Proportions& proportions, double length, RandomStream chips);
/// Half of the pediment: a wedge with vertical ends of height `left` and `right` [m].
Block makeTympanum(const Proportions& proportions, double length, double left, double right, RandomStream chips);
Block makeRakingCornice(const Proportions& proportions, double length, RandomStream chips);
Block makeTile(const Proportions& proportions, double length, RandomStream chips);

/// Extends the end at +x (`end` > 0) or -x of a block of the pediment's slope by `slope` times the height over its lower
/// face, so that it meets the other slope's in the ridge's vertical plane. The meshes then reach beyond the physics box
/// there, by `slope` times the block's height.
void mitre(Block& block, int end, double slope);

}  // namespace presa::temple
