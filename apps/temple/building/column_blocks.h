#pragma once
#include "apps/temple/building/block.h"
#include "apps/temple/building/proportions.h"
#include "framework/core/math/random.h"

namespace presa::temple {

/// Radius of the arrises at a height above the foot of the shaft, both in metres: a linear taper plus a parabolic
/// entasis.
double shaftRadius(const Proportions& proportions, double height);
/// Height of a drum [m].
double drumHeight(const Proportions& proportions);

/// Drum `i`, counted from below from 0, and the capital, in their own frames, without name and pose.
Block makeDrum(const Proportions& proportions, int i, RandomStream chips);
Block makeCapital(const Proportions& proportions, RandomStream chips);

}  // namespace presa::temple
