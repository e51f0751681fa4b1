#pragma once
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa::temple {

/// Points of a closed line, counter-clockwise seen against the direction in which rings are stacked [m].
using Ring = std::vector<Vec3>;

/// The closed surface through rings of as many points each, one after another; a fan from its `center` closes the first and the last,
/// which must be star-shaped about it. Points that rings share become one vertex.
TriMesh stackRings(const std::vector<Ring>& rings, const Vec3& first_center, const Vec3& last_center);

/// One break in an edge: points of `rim` within `width` of its point `at` move towards `inward` by at most `depth` [m].
struct Chip {
  std::size_t at = 0;
  double width = 0, depth = 0;
};
void chip(Ring& rim, const Chip& chip, const Vec3& inward);

/// Corners of a polygon with a point more at `margin` from each on every side longer than three of them.
Ring withMargins(const Ring& polygon, double margin);
/// `ring` scaled about `center`.
Ring scaled(const Ring& ring, const Vec3& center, double factor);
Ring moved(const Ring& ring, const Vec3& by);

/// Circle, square (edges along x and y) and flutes of radius, half width and arris radius `size` at height z; point i lies near the angle
/// 2 pi i / count, that of the squares exactly, so that one ring can be stacked on another. `count`: a multiple of eight.
Ring circle(double size, double z, std::size_t count);
Ring square(double size, double z, std::size_t count);
/// Each flute is a quarter circle between two arrises: the compass stands in the middle of a square on their chord [Vitruvius IV.3.9].
/// `count`: a multiple of `flutes`.
Ring fluted(double size, double z, std::size_t count, int flutes);

}  // namespace presa::temple
