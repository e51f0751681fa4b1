#pragma once
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa::temple {

/// Points of a closed polygon [m], counter-clockwise when seen against the direction in which rings are stacked.
using Ring = std::vector<Vec3>;

/// The closed surface through consecutive rings with equal numbers of points. A triangle fan around its center closes
/// the first and the last ring, which must be star-shaped about it. Coincident points become one vertex.
TriMesh stackRings(const std::vector<Ring>& rings, const Vec3& first_center, const Vec3& last_center);

/// One chip in an edge: points of `rim` within `width` of its point `at` move along the unit vector `inward` by at most
/// `depth` [m].
struct Chip {
  std::size_t at = 0;
  double width = 0, depth = 0;
};
void chip(Ring& rim, const Chip& chip, const Vec3& inward);

/// The polygon with an extra point at `margin` [m] from each corner, on every side longer than three margins.
Ring withMargins(const Ring& polygon, double margin);
/// `ring` scaled about `center` by `factor`.
Ring scaled(const Ring& ring, const Vec3& center, double factor);
Ring moved(const Ring& ring, const Vec3& by);

/// Rings of `count` points at height z [m]: circle of radius `size`, square of half width `size` (edges along x and y).
/// Point i is at the angle 2 pi i / count, so that rings of either kind can be stacked. `count`: a multiple of eight.
Ring circle(double size, double z, std::size_t count);
Ring square(double size, double z, std::size_t count);
/// A fluted ring with arrises at radius `size`, to be stacked with the other rings: point i is near the angle
/// 2 pi i / count. Each flute is a quarter circle between two arrises, its centre in the middle of a square on their
/// chord [Vitruvius IV.3.9]. `count`: a multiple of `flutes`.
Ring fluted(double size, double z, std::size_t count, int flutes);

}  // namespace presa::temple
