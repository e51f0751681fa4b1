#pragma once
#include "experiments/stability/polyhedra.h"

/// A semicircular arch of equal stones with radial joints and straight sides, and the limit analysis of its stability
/// [Heyman1966]: no tension, no crushing, no sliding.
namespace presa::stability {

struct MasonryArch {
  int stones = 15;
  double radius = 1;     ///< of the circle through the middles of the joints [m]
  double thickness = 0;  ///< of a joint [m]
};

/// True when some line of thrust passes through every joint, in balance with the weights: the arch then stands (static
/// theorem). Solved exactly: the unknowns are the horizontal thrust and its moment at the crown.
bool thrustLineFits(const MasonryArch& arch);
/// The thickness at which the arch starts to stand, in units of the radius. For many stones 0.1075 [Milankovitch1907;
/// Cocchetti2011].
double minThickness(int stones);

/// One stone, `width` along y. Its frame lies on the circle of `radius`, z outward, x along the circle.
Solid archStone(const MasonryArch& arch, double width);

}  // namespace presa::stability
