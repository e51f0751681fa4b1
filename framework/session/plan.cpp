#include "framework/session/plan.h"

#include <algorithm>

#include "framework/haptics/friction_laws.h"
#include "framework/haptics/surface_effects.h"
#include "framework/scene/manifest.h"

namespace presa {
namespace {

constexpr double kFastestRealTime = 10000;  // [Hz]
/// The haptic tick tests up to this many bodies faster than it reads a list of near ones.
constexpr std::size_t kFewTouchables = 32;

template <class Wanted>
std::string firstBody(const Scene& scene, const Wanted& wanted) {
  const auto found = std::find_if(scene.bodies.begin(), scene.bodies.end(), wanted);
  return found == scene.bodies.end() ? std::string{} : found->name;
}

const char* dynamicsPlugin(const Scene& scene) {
  switch (scene.dynamics.engine) {
    case DynamicsSettings::Engine::kMujoco:
      return "dynamics_mujoco";
    case DynamicsSettings::Engine::kBullet:
      return "dynamics_bullet";
    default:
      return "dynamics_ode";
  }
}

void planEffects(const Scene& scene, Plan& plan) {
  for (const PluginElement& element : scene.plugin_elements) {
    const bool known =
        std::ranges::any_of(plan.effects, [&](const PlannedEffect& e) { return e.plugin == element.plugin; });
    if (known || scene.devices.empty()) continue;
    if (element.kind != PluginKind::kForceEffect) continue;  // the others are planned below
    const std::string owner = element.body == kNoBody
                                  ? "the scene"
                                  : "body '" + scene.bodies[static_cast<std::size_t>(element.body)].name + "'";
    plan.effects.push_back({element.plugin, owner + " has <" + element.element + ">"});
  }
}

void planRenderer(const Scene& scene, Plan& plan) {
  if (scene.devices.empty()) return;
  const std::string& renderer = scene.haptics.renderer;
  plan.effects.push_back({renderer, "fingers meet bodies: <haptics renderer=\"" + renderer + "\">"});
}

/// The friction laws of the bodies that fingers can touch.
void planFriction(const Scene& scene, Plan& plan) {
  if (scene.devices.empty() || !scene.haptics.proxy) return;
  for (const Body& body : scene.bodies) {
    if (!body.haptic || !hasFriction(scene, body.material)) continue;
    const PluginElement law = frictionLawOf(scene, body.material);
    if (std::ranges::any_of(plan.effects, [&](const PlannedEffect& e) { return e.plugin == law.plugin; })) continue;
    const std::string& material = scene.materials[body.material].name;
    plan.effects.push_back({law.plugin, "material '" + material + "' has <" + law.element + ">"});
  }
}

void planSurfaceEffects(const Scene& scene, Plan& plan) {
  if (scene.devices.empty()) return;
  for (const PluginElement& effect : surfaceEffectsOf(scene)) {
    if (std::ranges::any_of(plan.effects, [&](const PlannedEffect& e) { return e.plugin == effect.plugin; })) continue;
    const std::string& body = scene.bodies[static_cast<std::size_t>(effect.body)].name;
    plan.effects.push_back({effect.plugin, "body '" + body + "' has <" + effect.element + ">"});
  }
}

/// Why the scene does not call for that plug-in.
std::string whyNot(const Manifest& manifest, const Scene& scene) {
  const auto of_it = [&](const PluginElement& element) { return element.plugin == manifest.name; };
  if (scene.devices.empty()) return "the scene has no device";
  if (manifest.kind == PluginKind::kRenderer) return "the scene's renderer is '" + scene.haptics.renderer + "'";
  if (manifest.needs_proxy && !scene.haptics.proxy) return "the renderer '" + scene.haptics.renderer + "' has no proxy";
  if (manifest.name == kShading) return "no touchable mesh says shading=\"smooth\"";
  if (manifest.name == kDefaultFrictionLaw) return "no touchable material has friction that names no law";
  if (std::ranges::any_of(scene.plugin_elements, of_it)) return "nothing touchable needs it";
  std::string elements;
  for (const Manifest::Element& element : manifest.elements)
    elements += (elements.empty() ? "<" : ", <") + element.name + ">";
  return "the scene has no " + elements + ": " + manifest.about;
}

/// What the scene could call for.
void leaveOutOthers(const Scene& scene, Plan& plan) {
  for (const Manifest& manifest : manifests()) {
    if (manifest.kind == PluginKind::kMethod) continue;  // no scene calls for it
    if (std::ranges::any_of(plan.effects, [&](const PlannedEffect& e) { return e.plugin == manifest.name; })) continue;
    plan.left_out.push_back({manifest.name, whyNot(manifest, scene)});
  }
}

}  // namespace

std::vector<PlannedDevice> bindDevices(const Scene& scene, const Rig& rig, Diagnostics& diagnostics) {
  std::vector<PlannedDevice> devices;
  std::vector<std::string> bound;
  for (const DeviceBinding& binding : rig.devices) bound.push_back(binding.role);
  for (const DeviceRole& role : scene.devices) {
    const auto binding = std::find_if(rig.devices.begin(), rig.devices.end(),
                                      [&](const DeviceBinding& b) { return b.role == role.role; });
    if (binding == rig.devices.end()) {
      diagnostics.error(405, role.where,
                        "role '" + role.role + "' is played by no device of the rig '" + rig.name + "'" +
                            didYouMean(role.role, bound),
                        rig.file.empty() ? "name a rig: --rig FILE, or the scene's attribute rig"
                                         : "add <device role=\"" + role.role + "\" driver=\"…\"/> to " + rig.file);
      continue;
    }
    devices.push_back({role.role, binding->driver});
  }
  return devices;
}

bool Plan::has(const std::string& plugin) const {
  return std::any_of(modules.begin(), modules.end(), [&](const PlannedModule& m) { return m.plugin == plugin; });
}

Plan makePlan(const Scene& scene, const Rig& rig, std::vector<PlannedDevice> devices, const RunOptions& options,
              Diagnostics& diagnostics) {
  Plan plan;
  plan.devices = std::move(devices);
  const auto call = [&](bool wanted, const char* plugin, RateGroup group, std::string why, std::string why_not) {
    if (wanted) {
      plan.modules.push_back({plugin, group, std::move(why)});
    } else {
      plan.left_out.push_back({plugin, std::move(why_not)});
    }
  };

  const std::string free = firstBody(scene, [](const Body& b) { return !b.fixed; });
  const std::string mesh =
      firstBody(scene, [](const Body& b) { return b.haptic && std::holds_alternative<MeshRef>(b.haptic->shape); });
  const std::string touchable = firstBody(scene, [](const Body& b) { return b.haptic.has_value(); });
  const bool fingers = !scene.devices.empty();

  call(fingers, "haptics_proxy", RateGroup::kHaptic,
       touchable.empty() ? "the scene has devices" : "fingers can touch body '" + touchable + "'",
       "the scene has no device");
  const auto touchables =
      static_cast<std::size_t>(std::ranges::count_if(scene.bodies, [](const Body& b) { return b.haptic.has_value(); }));
  call(fingers && (!mesh.empty() || touchables > kFewTouchables), "collision_fcl", RateGroup::kCollision,
       mesh.empty() ? std::to_string(touchables) + " bodies can be touched"
                    : "body '" + mesh + "' has a mesh as haptic geometry",
       fingers ? "few haptic geometries, and all of them primitives, which the haptic tick handles exactly"
               : "the scene has no device");
  const char* dynamics = dynamicsPlugin(scene);
  if (fingers && !free.empty() && scene.dynamics.engine != DynamicsSettings::Engine::kOde) {
    diagnostics.error(407, {scene.file, 0, 0},
                      std::string("the scene has devices, and ") + dynamics + " does not support fingers",
                      "use engine=\"ode\"; the other engines serve for comparison and do not support fingers");
  }
  if (scene.assembly && scene.dynamics.engine != DynamicsSettings::Engine::kOde) {
    diagnostics.error(409, {scene.file, 0, 0},
                      std::string("the scene has an assembly, and ") + dynamics + " does not support snap constraints",
                      "engine=\"ode\"");
  }
  if (options.realtime && scene.rates.haptic > kFastestRealTime) {
    diagnostics.error(408, {scene.file, 0, 0}, "a haptic rate above 10000 Hz cannot be kept against the clock",
                      "use --lockstep, in which finer steps serve as a reference for coarser ones");
  }
  call(scene.assembly.has_value(), "assembly", RateGroup::kCollision, "bodies are to be put together",
       "the scene has no assembly");
  planRenderer(scene, plan);
  planEffects(scene, plan);
  planFriction(scene, plan);
  planSurfaceEffects(scene, plan);
  leaveOutOthers(scene, plan);
  call(!free.empty(), dynamics, RateGroup::kDynamics, "body '" + free + "' is free", "every body is fixed");
  call(!options.record.empty() || !options.flight.empty(), "record", RateGroup::kHaptic,
       options.record.empty() ? "the last two seconds are kept for a fault" : "the run is recorded",
       "nothing is recorded");
  call(options.view != RunOptions::View::kNone, "view_osg", RateGroup::kView,
       options.view == RunOptions::View::kWindow ? "--view window" : "a picture is wanted", "no view is wanted");
  const std::optional<BusSettings> bus = busOf(scene, rig, options);
  call(bus.has_value(), "bus_dds", RateGroup::kBus,
       !bus          ? ""
       : options.bus ? "--bus " + bus->network
                     : (rig.bus ? "the rig '" + rig.name : "the scene '" + scene.name) + "' publishes on bus '" +
                           bus->network + "'",
       "no bus was requested (--bus)");
  return plan;
}

}  // namespace presa
