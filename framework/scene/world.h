#pragma once
#include <memory>
#include <vector>

#include "framework/geometry/mesh_tree.h"
#include "framework/geometry/tri_mesh.h"
#include "framework/scene/scene.h"

namespace presa {

struct Model;  // framework/geometry/model.h

/// A mesh cut into convex pieces.
struct ConvexPieces {
  std::vector<std::shared_ptr<const TriMesh>> pieces;  ///< convex, closed
  double error = 0;  ///< Hausdorff distance between the mesh and the union of the pieces, as solids [m]
};

/// Meshes of one body; null where the geometry is a primitive or absent.
struct BodyMeshes {
  std::shared_ptr<const TriMesh> visual,                ///< drawn
      haptic,                                           ///< felt by fingers
      physics;                                          ///< met by other bodies
  std::shared_ptr<const MeshTree> haptic_tree;          ///< hierarchy over `haptic`; null when no finger can touch it
  std::vector<std::shared_ptr<const TriMesh>> parts{};  ///< physics, of a Compound: by part; else empty
  std::vector<ConvexPieces> decomposed{};  ///< physics, by shape, no pieces: as it is; empty: none is decomposed
  std::shared_ptr<const Model> model{};    ///< of `visual`, for the view alone; null: its file says nothing of colours
};

/// Mass [kg], centre of mass in the body frame [m], inertia about it in body axes [kg m^2]. Zero mass: fixed body.
struct BodyInertia {
  double mass = 0;              ///< [kg]; 0: a fixed body
  Vec3 p_BCm = Vec3::Zero();    ///< centre of mass [m]
  Mat3 inertia = Mat3::Zero();  ///< about p_BCm, in body axes [kg m^2]
};

/// The scene with its meshes loaded and its masses computed. Constant during a run, shared by all modules and threads.
struct World {
  Scene scene;                                          ///< as loaded
  Rig rig;                                              ///< as loaded
  std::vector<BodyMeshes> meshes;                       ///< as Scene::bodies
  std::vector<BodyInertia> inertias;                    ///< as Scene::bodies
  std::vector<std::shared_ptr<const TriMesh>> tools{};  ///< as Scene::devices, in the handle's frame T; null: no tool
};

/// Reads every mesh the scene names (each file once) and computes mass properties from the physics geometry.
World buildWorld(Scene scene, Rig rig, Diagnostics& diagnostics);

/// Builds the hierarchies over the haptic meshes, one per mesh, when the scene has devices. Called by buildWorld.
void indexHapticMeshes(World& world);

}  // namespace presa
