#include "apps/presa/check/start_warnings.h"

#include <algorithm>
#include <cmath>

#include "apps/common/grasp_loop.h"
#include "apps/common/terminal/text.h"
#include "apps/presa/check/overlap.h"
#include "apps/presa/explain/module_times.h"
#include "framework/core/diagnostics/printable.h"
#include "framework/scene/physics_shapes.h"
#include "framework/session/session.h"

namespace presa::check {
namespace {

enum StartWarningCode { kOverlap = 241, kHugeMesh = 242, kFarFinger = 243, kSlowMesh = 244, kExplicitGrasp = 245 };

using terminal::format;

constexpr double kTolerance = 5e-4;  // [m]; a scene that stacks bodies by rounded numbers stays below
constexpr double kHuge = 20;         // [m]; a house: nobody picks up more
constexpr double kFar = 1;           // [m]; an arm reaches that far

void warnOfOverlaps(const World& world, Diagnostics& diagnostics) {
  for (const Overlap& o : overlapsOf(world, kTolerance)) {
    const Body &first = world.scene.bodies[o.first], &second = world.scene.bodies[o.second];
    const bool moves_second = !second.fixed;
    const Body& mover = moves_second ? second : first;
    const Vec3 way = (moves_second ? 1 : -1) * o.depth * o.nhat_W;
    diagnostics.warning(kOverlap, mover.where,
                        quote(first.name) + " and " + quote(second.name) +
                            format(" overlap by %.2f mm at the start", 1e3 * o.depth) +
                            ": the first steps push them apart",
                        format("move %s by %.4f %.4f %.4f m", quote(mover.name).c_str(), way.x(), way.y(), way.z()));
  }
}

void warnOfMesh(const Body& body, const Geometry& geometry, const TriMesh* mesh, Diagnostics& diagnostics) {
  const auto* named = std::get_if<MeshRef>(&geometry.shape);
  if (named == nullptr || mesh == nullptr || mesh->vertices.empty()) return;
  const AxisBox box = boundsOf(*mesh);
  const double size = (box.high - box.low).maxCoeff();
  if (size < kHuge) return;
  diagnostics.warning(kHugeMesh, geometry.where,
                      "the mesh " + quote(named->file) + " of " + quote(body.name) + format(" is %.4g m wide", size) +
                          ": its file may be in millimetres, which are taken for metres",
                      format("scale=\"%.4g %.4g %.4g\" makes it %.4g m wide", named->scale.x() / 1000,
                             named->scale.y() / 1000, named->scale.z() / 1000, size / 1000));
}

/// A body that moves and has no mesh of its own; one that stands still may be a floor or a hall.
void warnOfSize(const Body& body, const BodyMeshes& meshes, Diagnostics& diagnostics) {
  if (body.fixed || !body.physics || std::holds_alternative<MeshRef>(body.physics->shape)) return;
  double size = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 n = Vec3::Unit(axis);
    size = std::max(size, supportOf(body, meshes, n) + supportOf(body, meshes, -n));
  }
  if (size < kHuge) return;
  diagnostics.warning(
      kHugeMesh, body.physics->where,
      quote(body.name) + format(" is %.4g m wide: its size may be in millimetres, which are taken for metres", size),
      format("lengths are in metres: %.4g m for %.4g mm", size / 1000, size));
}

void warnOfMeshes(const World& world, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < world.scene.bodies.size(); ++i) {
    const Body& body = world.scene.bodies[i];
    const BodyMeshes& meshes = world.meshes[i];
    warnOfSize(body, meshes, diagnostics);
    if (body.haptic) warnOfMesh(body, *body.haptic, meshes.haptic.get(), diagnostics);
    if (body.physics) warnOfMesh(body, *body.physics, meshes.physics.get(), diagnostics);
    if (body.visual) warnOfMesh(body, *body.visual, meshes.visual.get(), diagnostics);
  }
}

/// Bounding box in the world of what a finger can touch, or else of what bodies meet.
AxisBox boxOf(const Body& body, const BodyMeshes& meshes) {
  const std::optional<Geometry>& geometry = body.haptic ? body.haptic : body.physics;
  AxisBox box;
  if (!geometry) return box;
  const Pose X_WG = body.X_WB * geometry->X_BG;
  const TriMesh* mesh = body.haptic ? meshes.haptic.get() : meshes.physics.get();
  const auto reach = [&](const Vec3& n) {
    return n.dot(X_WG.p) + supportOf(geometry->shape, mesh, X_WG.q.inverse() * n);
  };
  for (int axis = 0; axis < 3; ++axis) {
    box.high[axis] = reach(Vec3::Unit(axis));
    box.low[axis] = -reach(-Vec3::Unit(axis));
  }
  return box;
}

struct Nearest {
  double distance = 1e300;
  const Body* body = nullptr;
};

Nearest nearestBody(const World& world, const Vec3& p_W) {
  Nearest nearest;
  for (std::size_t i = 0; i < world.scene.bodies.size(); ++i) {
    const AxisBox box = boxOf(world.scene.bodies[i], world.meshes[i]);
    if (!(box.low.x() <= box.high.x())) continue;
    const double distance = ((box.low - p_W).cwiseMax(p_W - box.high)).cwiseMax(0.0).norm();
    if (distance < nearest.distance) nearest = {distance, &world.scene.bodies[i]};
  }
  return nearest;
}

/// A model knows where its finger starts; a person's is not known before the run.
void warnOfFingers(const Loaded& loaded, Diagnostics& diagnostics) {
  const World& world = *loaded.world;
  for (std::size_t f = 0; f < loaded.devices.size() && f < world.scene.devices.size(); ++f) {
    Device& device = *loaded.devices[f];
    if (device.model().empty()) continue;
    const FingerInput start = device.read({.period = 1 / world.scene.rates.haptic});
    const Nearest nearest = nearestBody(world, start.p_WH);
    if (!start.valid || nearest.body == nullptr || nearest.distance < kFar) continue;
    diagnostics.warning(kFarFinger, world.scene.devices[f].where,
                        "the finger " + quote(world.scene.devices[f].role) +
                            format(" starts %.2f m from the nearest body, ", nearest.distance) +
                            quote(nearest.body->name) +
                            format(", at %.3g %.3g %.3g", start.p_WH.x(), start.p_WH.y(), start.p_WH.z()),
                        "lengths are in metres: check the points of its motion and the pos of the body");
  }
}

/// Free bodies whose physics is a mesh as it is, with its triangles.
std::vector<std::pair<std::size_t, std::size_t>> meshBodies(const World& world) {
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t i = 0; i < world.scene.bodies.size(); ++i) {
    const Body& body = world.scene.bodies[i];
    if (body.fixed || !body.physics) continue;
    const auto* mesh = std::get_if<MeshRef>(&body.physics->shape);
    if (mesh != nullptr && !mesh->decompose && world.meshes[i].physics)
      found.emplace_back(i, world.meshes[i].physics->triangles.size());
  }
  return found;
}

/// The slowest rate of the dynamics at which a mass is enough, or nothing where not even the haptic rate is.
std::string fasterDynamics(const Scene& scene, double mass, double needed) {
  const double ticks = std::floor(scene.rates.haptic / (scene.rates.dynamics * std::sqrt(needed / mass)));
  return ticks < 1 ? "" : format(", or <rates dynamics=\"%.6g\">", scene.rates.haptic / ticks);
}

}  // namespace

void warnOfStart(const Loaded& loaded, Diagnostics& diagnostics) {
  warnOfOverlaps(*loaded.world, diagnostics);
  warnOfMeshes(*loaded.world, diagnostics);
  warnOfFingers(loaded, diagnostics);
  warnOfExplicitGrasps(*loaded.world, diagnostics);
}

void warnOfExplicitGrasps(const World& world, Diagnostics& diagnostics) {
  const Scene& scene = world.scene;
  if (scene.dynamics.coupling != DynamicsSettings::Coupling::kExplicit) return;
  const double period = 1 / scene.rates.dynamics;
  for (const GraspLoop& loop : graspLoops(world)) {
    const double needed = kExplicitMargin * loop.explicitMinMass(period);
    if (loop.mass >= needed) continue;
    const Body& body = scene.bodies[loop.body];
    diagnostics.warning(
        kExplicitGrasp, body.where,
        format("%zu fingers of %.4g N/m on ", loop.fingers, loop.stiffness) + quote(body.name) +
            format(" of %.4g kg may shake it out of their grasp: coupling=\"explicit\" at %.4g Hz needs %.4g kg "
                   "(n K h^2 / 4 = %.4g kg, and a margin of %.2g)",
                   loop.mass, scene.rates.dynamics, needed, loop.explicitMinMass(period), kExplicitMargin),
        "coupling=\"soft\" holds it" + fasterDynamics(scene, loop.mass, needed));
  }
}

void warnOfSlowMeshes(const World& world, double step, Diagnostics& diagnostics) {
  const double period = 1 / world.scene.rates.dynamics;
  if (step <= period) return;
  for (const auto& [body, triangles] : meshBodies(world)) {
    diagnostics.warning(kSlowMesh, world.scene.bodies[body].physics->where,
                        quote(world.scene.bodies[body].name) + " has a mesh of " + std::to_string(triangles) +
                            format(" triangles as its physics, and a step of the dynamics takes %.3g ms here, more "
                                   "than its period of %.3g ms",
                                   1e3 * step, 1e3 * period),
                        "a box or cylinder as <physics>, a coarser mesh, or decompose=\"true\" is faster");
  }
}

void warnOfSlowMeshes(Loaded loaded, double simulated, Diagnostics& diagnostics) {
  const std::shared_ptr<const World> world = loaded.world;
  const bool models = std::ranges::all_of(loaded.devices, [](const auto& device) { return !device->model().empty(); });
  if (!models || meshBodies(*world).empty()) return;
  RunControl control;
  Session session(std::move(loaded), control, {});
  double slowest = 0;
  for (const auto& [name, time] : measureModuleTimes(session.graph(), RateTable(world->scene.rates), simulated)) {
    const Module* module = session.graph().find(name);
    if (module != nullptr && module->group() == RateGroup::kDynamics)
      slowest = std::max(slowest, 1e-9 * time.median_ns);
  }
  warnOfSlowMeshes(*world, slowest, diagnostics);
}

}  // namespace presa::check
