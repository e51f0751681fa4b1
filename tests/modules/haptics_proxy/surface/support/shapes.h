#pragma once
#include "framework/geometry/tri_mesh.h"

namespace presa::test {

/// Each with adjacency, centred at the origin, counter-clockwise seen from outside.

/// An icosahedron whose faces are cut into n^2 each: 20 n^2 triangles, corners on the sphere.
TriMesh icosphere(int n, double radius);
/// The largest angle between a facet's normal and the sphere's at a point of that facet, for the icosphere above [rad]:
/// its facets are at most as long as those in the middle of a face, 1.2 times the mean edge of the icosahedron / n.
double facetAngle(int n);
/// A box whose sides are cut into m x m squares each: 12 m^2 triangles.
TriMesh cutBox(const Vec3& size, int m);
/// A level square sheet of 2 m^2 triangles, open, facing +z.
TriMesh sheet(double size, int m);

/// All of `other` beside what `mesh` has; adjacency is left to the caller.
void append(TriMesh& mesh, const TriMesh& other, const Vec3& offset = Vec3::Zero());

}  // namespace presa::test
