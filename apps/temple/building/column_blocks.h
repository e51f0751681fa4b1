#pragma once
#include "apps/temple/building/block.h"
#include "apps/temple/building/proportions.h"
#include "framework/core/math/random.h"

namespace presa::temple {

/// Radius of the arrises at a height above the foot of the shaft, both in metres: a straight taper and a parabola on it.
double shaftRadius(const Proportions& proportions, double height);
/// Height of a drum [m].
double drumHeight(const Proportions& proportions);

/// Drum `i` from below and the capital, in their own frames, without name and place.
Block makeDrum(const Proportions& proportions, int i, RandomStream chips);
Block makeCapital(const Proportions& proportions, RandomStream chips);

}  // namespace presa::temple
