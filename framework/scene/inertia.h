#pragma once
#include "framework/scene/world.h"

namespace presa {

/// Volume, centre and inertia for density 1 of a shape in its own frame G: closed forms, the divergence theorem for a
/// mesh (`mesh` is only read for a MeshRef).
MassProperties massPropertiesOf(const Shape& shape, const TriMesh* mesh);

/// Mass, centre of mass and inertia of a free body from its physics geometry, in the body frame; all zero for a fixed
/// body. E320: no physics geometry; E321: mass, volume or inertia that is not positive.
BodyInertia inertiaOf(const Body& body, const TriMesh* physics_mesh, Diagnostics& diagnostics);

}  // namespace presa
