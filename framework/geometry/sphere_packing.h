#pragma once
#include <functional>
#include <vector>

#include "framework/geometry/tri_mesh.h"

namespace presa {

/// A sphere within a solid.
struct InnerSphere {
  Vec3 centre = Vec3::Zero();  ///< [m]
  double radius = 0;           ///< [m]
};

/// Up to `count` spheres in a solid that do not overlap, largest first: each is, as far as a grid of `cells` points and
/// steps from there can tell, the largest that still finds room [Weller2009]. `depth`: distance of a point from the
/// surface, positive inside [m]; `bounds`: around the solid. Deterministic. Thread: before a run.
std::vector<InnerSphere> packSpheres(const std::function<double(const Vec3&)>& depth, const AxisBox& bounds,
                                     std::size_t count, std::size_t cells = 60000);

/// Volume in which spheres of radii r and q overlap whose centres are `apart` [m^3].
double overlapVolume(double r, double q, double apart) noexcept;
/// Area of the disc in which their surfaces cross, by which the volume falls with `apart` [m^2]; 0 where they do not.
double overlapArea(double r, double q, double apart) noexcept;

}  // namespace presa
