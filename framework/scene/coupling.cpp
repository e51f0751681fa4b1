// The coupling of a scene that states none. At the rate of the dynamics a body learns of a force one step late, so it
// gets the impulse that fingers feel within 1 % only where forces change little within a step; at the haptic rate it
// gets exactly that impulse, at 2.8 times the instructions of a tick. So the haptic rate is taken where the scene calls
// for it, and where a tick is short enough to move the body.
#include <algorithm>
#include <iomanip>
#include <sstream>

#include "framework/scene/inertia.h"
#include "framework/scene/manifest.h"
#include "framework/scene/physics_shapes.h"
#include "framework/scene/scene_parts.h"
#include "framework/scene/xml/listed.h"

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

/// A needle of 3 g held by its ends at 100 rad/s leaves the fingers at 1000 Hz; at 200 Hz it is solved in more, smaller
/// steps (modules/dynamics_ode).
bool turnsLittle(const Body& body, const Scene& scene) {
  constexpr double kTurn = 0.05;  // in a tick [rad]
  return body.w_WB.norm() < kTurn * scene.rates.haptic;
}

/// Of physics meshes any: whether ODE will collide them (E272) is not known before they are read.
bool hapticThreadCanMove(const Scene& scene, const xml::Element& root) {
  return obstaclesToHapticRate(root).empty() && !scene.devices.empty() && std::ranges::none_of(scene.bodies, hasMesh) &&
         std::ranges::all_of(scene.bodies, [&](const Body& body) {
           return body.fixed || !body.haptic || (isHeavyEnough(body, scene) && turnsLittle(body, scene));
         });
}

// Bounds below which a body gets the impulse within 1 % at the rate of the dynamics: measured on the cube at 40 to
// 500 Hz and 1 to 10 N/mm, and on a needle that spins between fingers.
constexpr double kHandSpeed = 0.05;  // [m/s]
constexpr double kQuickForce = 0.8;  // in a step [N]
constexpr double kQuickTurn = 0.06;  // in a step [rad]

std::string inUnits(double value, const char* unit) {
  std::ostringstream text;
  text << std::setprecision(2) << value << ' ' << unit;
  return text.str();
}

/// "a finger at 50 mm/s changes the force on 'cube' by 1 N", or empty.
std::string quickForceOn(const Body& body, const Scene& scene) {
  const double force = scene.materialOf(body).stiffness * kHandSpeed / scene.rates.dynamics;
  if (force < kQuickForce) return {};
  return "a finger at 50 mm/s changes the force on '" + body.name + "' by " + inUnits(force, "N");
}

/// "'needle' turns by 0.15 rad", or empty.
std::string quickTurnOf(const Body& body, const Scene& scene) {
  const double turn = body.w_WB.norm() / scene.rates.dynamics;
  return turn < kQuickTurn ? "" : "'" + body.name + "' turns by " + inUnits(turn, "rad");
}

/// "<texture> changes the force on 'block'", or empty.
std::string quickElementOn(const Body& body, const Scene& scene) {
  const auto quick = std::ranges::find_if(scene.plugin_elements, [&](const PluginElement& element) {
    return isQuick(element) && actsOn(element, body, scene);
  });
  return quick == scene.plugin_elements.end() ? ""
                                              : '<' + quick->element + "> changes the force on '" + body.name + "'";
}

/// Why forces change within a step of the dynamics, or empty.
std::string reasonFor(const Scene& scene) {
  for (const auto of : {quickElementOn, quickForceOn, quickTurnOf}) {
    for (const Body& body : scene.bodies) {
      if (body.fixed || !body.haptic) continue;
      if (const std::string reason = of(body, scene); !reason.empty()) return reason + " within a step of the dynamics";
    }
  }
  return {};
}

}  // namespace

bool statesCoupling(const xml::Element& root) {
  return std::ranges::any_of(root.children("dynamics"),
                             [](const xml::Element& dynamics) { return dynamics.hasAttribute("coupling"); });
}

std::vector<CouplingObstacle> obstaclesToHapticRate(const xml::Element& root) {
  static const std::vector<std::pair<const char*, std::vector<std::string>>> kOwn{
      {"engine", {kDefaultEngine}},
      {"solver", {"auto", "newton", "small_steps"}},
      {"friction", {"isotropic"}},
      {"rotation", {"exact"}}};
  std::vector<CouplingObstacle> obstacles;
  for (const xml::Element& dynamics : root.children("dynamics")) {
    for (const auto& [name, allowed] : kOwn) {
      if (!dynamics.hasAttribute(name) || dynamics.flawed(name)) continue;
      const std::string value = dynamics.attribute(name);
      if (std::ranges::find(allowed, value) != allowed.end()) continue;
      obstacles.push_back({dynamics.where(name), std::string(name) + "=\"" + value + "\"",
                           std::string("allowed for ") + name + ": " + listed(allowed) + "; or another coupling"});
    }
  }
  for (const xml::Element& assembly : root.children("assembly"))
    obstacles.push_back(
        {assembly.where(), "an <assembly>, whose snap constraints act in the dynamics", "use the coupling 'soft'"});
  return obstacles;
}

void chooseCoupling(Scene& scene, const xml::Element& root) {
  std::string reason = reasonFor(scene);
  if (reason.empty() || !hapticThreadCanMove(scene, root)) return;
  scene.dynamics.coupling = DynamicsSettings::Coupling::kHapticRate;
  scene.dynamics.coupling_reason = std::move(reason);
  for (xml::Element dynamics : root.children("dynamics"))
    dynamics.setAttribute("coupling", "haptic_rate", dynamics.where());
}

}  // namespace presa
