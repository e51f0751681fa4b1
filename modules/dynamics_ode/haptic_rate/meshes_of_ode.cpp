#include "modules/dynamics_ode/haptic_rate/meshes_of_ode.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/scene/physics_shapes.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/convex/hull_contacts.h"

namespace presa::ode {
namespace {

enum MeshesOfOdeCode { kMeshOfOde = 272 };

struct Solid {
  std::size_t body;
  bool mesh;
  std::optional<Hull> hull;
};

std::vector<Solid> solidsOf(const World& world) {
  std::vector<Solid> solids;
  for (std::size_t i = 0; i < world.scene.bodies.size(); ++i) {
    for (const PhysicsShape& shape : physicsShapes(world.scene.bodies[i], world.meshes[i]))
      solids.push_back({i, shape.mesh != nullptr, polyhedronOf(shape)});
  }
  return solids;
}

bool leftToOde(const Solid& mesh, const Solid& other) {
  return !mesh.hull || !other.hull || !HullContacts::collides(*mesh.hull, *other.hull);
}

}  // namespace

void refuseMeshesOfOde(const World& world) {
  const std::vector<Body>& bodies = world.scene.bodies;
  const std::vector<Solid> solids = solidsOf(world);
  Diagnostics diagnostics;
  for (const Solid& mesh : solids) {
    if (!mesh.mesh) continue;
    const auto meets = std::ranges::find_if(solids, [&](const Solid& other) {
      const bool moves = !bodies[mesh.body].fixed || !bodies[other.body].fixed;
      return other.body != mesh.body && moves && leftToOde(mesh, other);
    });
    if (meets == solids.end()) continue;
    const std::string what = mesh.hull
                                 ? "and '" + bodies[meets->body].name + "', a cylinder, which a mesh meets as triangles"
                                 : "is not convex, or has more than " + std::to_string(kMaxMeshFaces) + " faces";
    diagnostics.error(kMeshOfOde, bodies[mesh.body].where,
                      "in real time the coupling 'haptic_rate' does not go with this physics mesh: '" +
                          bodies[mesh.body].name + "' " + what,
                      "give it decompose=\"true\" or primitives, use the coupling 'soft', or run it with --lockstep");
    break;
  }
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
}

}  // namespace presa::ode
