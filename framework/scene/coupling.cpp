// The coupling of a scene that states none. At the rate of the dynamics a body learns of a force one step late, so it
// gets the impulse that fingers feel within 1 % only where forces change little within a step; at the haptic rate it
// gets exactly that impulse, at 2.8 times the instructions of a tick. So the haptic rate is taken where the scene calls
// for it, and where a tick is short enough to move the body.
#include <algorithm>

#include "framework/scene/inertia.h"
#include "framework/scene/manifest.h"
#include "framework/scene/physics_shapes.h"
#include "framework/scene/scene_parts.h"

namespace presa {
namespace {

bool isQuick(const PluginElement& element) {
  const Manifest::Element* of_manifest = findElement(element.element);
  return of_manifest != nullptr && of_manifest->quick;
}

/// An element in neither a body nor a material acts on every touchable body.
bool actsOn(const PluginElement& element, const Body& body, const Scene& scene) {
  if (element.body != kNoBody) return &scene.bodies[static_cast<std::size_t>(element.body)] == &body;
  return element.material < 0 || static_cast<std::size_t>(element.material) == body.material;
}

bool hasMesh(const Body& body) {
  return std::ranges::any_of(physicsShapes(body, {}),
                             [](const PhysicsShape& each) { return std::holds_alternative<MeshRef>(*each.shape); });
}

/// A tick of the haptic thread is short enough for the spring of a contact to move the body stably: k T^2 <= m.
bool isHeavyEnough(const Body& body, const Scene& scene) {
  Diagnostics of_inertia;  // reported where the world is loaded
  const double mass = inertiaOf(body, {}, of_inertia).mass;
  return mass * scene.rates.haptic * scene.rates.haptic >= scene.materialOf(body).stiffness;
}

/// As E228, and E272 for any physics mesh: whether ODE will collide it is not known before it is read.
bool hapticThreadCanMove(const Scene& scene) {
  using D = DynamicsSettings;
  const D& dynamics = scene.dynamics;
  const bool own_solver = dynamics.solver == D::Solver::kAuto || dynamics.solver == D::Solver::kNewton ||
                          dynamics.solver == D::Solver::kSmallSteps;
  return dynamics.engine == kDefaultEngine && own_solver && dynamics.friction == D::Friction::kIsotropic &&
         dynamics.rotation == D::Rotation::kExact && !scene.assembly && !scene.devices.empty() &&
         std::ranges::none_of(scene.bodies, hasMesh) && std::ranges::all_of(scene.bodies, [&](const Body& body) {
           return body.fixed || !body.haptic || isHeavyEnough(body, scene);
         });
}

/// "<texture> changes the force on 'block' within a step of the dynamics", or empty.
std::string reasonFor(const Scene& scene) {
  for (const PluginElement& element : scene.plugin_elements) {
    if (!isQuick(element)) continue;
    const auto touched = std::ranges::find_if(
        scene.bodies, [&](const Body& body) { return !body.fixed && body.haptic && actsOn(element, body, scene); });
    if (touched != scene.bodies.end())
      return '<' + element.element + "> changes the force on '" + touched->name + "' within a step of the dynamics";
  }
  return {};
}

}  // namespace

bool statesCoupling(const xml::Element& root) {
  return std::ranges::any_of(root.children("dynamics"),
                             [](const xml::Element& dynamics) { return dynamics.hasAttribute("coupling"); });
}

void chooseCoupling(Scene& scene, const xml::Element& root) {
  std::string reason = reasonFor(scene);
  if (reason.empty() || !hapticThreadCanMove(scene)) return;
  scene.dynamics.coupling = DynamicsSettings::Coupling::kHapticRate;
  scene.dynamics.coupling_reason = std::move(reason);
  for (xml::Element dynamics : root.children("dynamics"))
    dynamics.setAttribute("coupling", "haptic_rate", dynamics.where());
}

}  // namespace presa
