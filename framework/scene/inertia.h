#pragma once
#include "framework/scene/world.h"

namespace presa {

/// Volume [m^3], centroid [m] and inertia for density 1 kg/m^3 of a shape in its own frame G. Closed forms for
/// primitives, the divergence theorem for a mesh (`mesh` is read for a MeshRef only); all zero for a Compound.
MassProperties massPropertiesOf(const Shape& shape, const TriMesh* mesh);

/// Mass, centre of mass and inertia of a free body from its physics geometry, in the body frame; all zero for a fixed
/// body. Several shapes have one density and count in full, also where they overlap. A decomposed mesh counts as it was
/// before. Centre of mass and inertia that the scene gives replace those of the shapes. E320: no physics geometry; E321: mass or inertia not physically valid.
BodyInertia inertiaOf(const Body& body, const BodyMeshes& meshes, Diagnostics& diagnostics);

}  // namespace presa
