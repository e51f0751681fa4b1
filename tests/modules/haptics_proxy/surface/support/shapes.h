#pragma once
#include "framework/geometry/tri_mesh.h"

namespace presa::test {

/// All with adjacency, centred at the origin, counter-clockwise seen from outside.

/// An icosahedron whose faces are subdivided into n^2 each: 20 n^2 triangles, vertices on the sphere.
TriMesh icosphere(int n, double radius);
/// Upper bound of the angle between the normals of a facet and of the sphere at a point of that facet, for the
/// icosphere above [rad]. Its longest facet edges, in the middle of a face, are 1.2 times the mean edge of the
/// icosahedron / n.
double facetAngle(int n);
/// A box whose sides are divided into m x m squares each: 12 m^2 triangles.
TriMesh cutBox(const Vec3& size, int m);
/// A level square sheet of 2 m^2 triangles, open, facing +z.
TriMesh sheet(double size, int m);

/// Appends `other` to `mesh`; the caller builds the adjacency.
void append(TriMesh& mesh, const TriMesh& other, const Vec3& offset = Vec3::Zero());

}  // namespace presa::test
