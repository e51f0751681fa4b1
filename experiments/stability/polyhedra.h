#pragma once
#include <array>
#include <string>
#include <vector>

#include "framework/core/math/spatial.h"

/// Solids bounded by planes: meshes with exact nearest points.
namespace presa::stability {

/// The half-space nhat . p >= offset.
struct Plane {
  Vec3 nhat = Vec3::UnitZ();
  double offset = 0;
};
/// The nearest point to p inside all half-spaces, by testing every set of at most three planes: slow but simple. Throws
/// std::logic_error when the half-spaces have no common point.
Vec3 nearestInAll(const std::vector<Plane>& half_spaces, const Vec3& p);

struct Solid {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
  /// For a hollow: its walls, normals into the (convex) free space. For a convex body: its faces, normals inward.
  std::vector<Plane> planes;
  bool hollow = false;
  Vec3 feature = Vec3::Zero();   ///< the bottom of the hollow, or the tip or corner of the body [m]
  Vec3 outward = Vec3::UnitZ();  ///< unit, from the feature into free space
};

/// A block with a groove along y whose walls meet at `angle_deg`; upper face at z = 0.
Solid grooved(double angle_deg, double depth);
/// A block with a pit of `walls` walls; its bottom is `depth` below the upper face z = 0, `inradius` is at the upper
/// face.
Solid pitted(int walls, double inradius, double depth);
/// A pyramid of eight sides with its tip at z = 0.
Solid needle(double length, double radius);
/// A block with its upper face at z = 0, its faces cut into strips of the given widths along x [m].
Solid striped(const std::vector<double>& widths, double edge);

/// Writes the mesh as Wavefront OBJ with full precision.
void writeObj(const Solid& solid, const std::string& file);

}  // namespace presa::stability
