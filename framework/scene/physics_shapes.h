#pragma once
#include <vector>

#include "framework/scene/world.h"

namespace presa {

/// One of the shapes that a body's physics geometry consists of, in the body frame. `shape` is no Compound; `mesh` is
/// its mesh, or one convex piece of it, and null for a primitive. Valid as long as the body and its meshes are.
struct PhysicsShape {
  const Shape* shape = nullptr;   ///< of the Body; not owned
  const TriMesh* mesh = nullptr;  ///< of the BodyMeshes; not owned
  Pose X_BG;                      ///< pose of the shape in the body
};

/// The shapes of a body's physics geometry in document order, the pieces of a decomposed mesh in its place; none
/// without physics geometry.
std::vector<PhysicsShape> physicsShapes(const Body& body, const BodyMeshes& meshes);
bool hasSeveralShapes(const Body& body, const BodyMeshes& meshes);  ///< more than one PhysicsShape

/// Support of a shape in the unit direction `nhat_G` of its own frame: max of nhat_G . p over its points [m]. 0 for a
/// mesh that is absent, and for a Compound.
double supportOf(const Shape& shape, const TriMesh* mesh, const Vec3& nhat_G);
/// The same of a body's physics geometry, in the body frame [m]; 0 without one.
double supportOf(const Body& body, const BodyMeshes& meshes, const Vec3& nhat_B);

/// All meshes that a scene names: of each body, visual, haptic and physics ones.
std::vector<MeshRef*> meshesOf(Scene& scene);
/// The same, read only.
std::vector<const MeshRef*> meshesOf(const Scene& scene);

}  // namespace presa
