#pragma once
#include <memory>
#include <vector>

#include "framework/geometry/tri_mesh.h"

/// Meshes of round parts that are no primitives. About z; closed, triangles counter-clockwise seen from outside.
namespace presa::percro {

struct ProfileCorner {
  double r, z;  ///< [m]
};
/// Solid of revolution of a closed outline, counter-clockwise with r to the right and z upwards, from one angle to another
/// [rad]; a part of a turn has flat ends.
std::shared_ptr<const TriMesh> revolved(const std::vector<ProfileCorner>& outline, double from, double to);
/// Whole turn.
std::shared_ptr<const TriMesh> revolved(const std::vector<ProfileCorner>& outline);

/// Bar of round section, bent about z to this radius.
std::shared_ptr<const TriMesh> bow(double radius, double thickness, double from, double to);
/// Tube between two radii, centred.
std::shared_ptr<const TriMesh> tube(double inner, double outer, double length);

}  // namespace presa::percro
