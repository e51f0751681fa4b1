#include "framework/session/plan.h"

#include <algorithm>

#include "framework/device/frame_tree.h"
#include "framework/haptics/body_effects.h"
#include "framework/haptics/friction_laws.h"
#include "framework/haptics/surface_effects.h"
#include "framework/scene/manifest.h"
#include "framework/scene/scene_facts.h"

namespace presa {
namespace {

enum PlanCode { kHits = 265 };

constexpr double kFastestRealTime = 10000;  // [Hz]

/// "body 'cube'", "the scene"
std::string ownerOf(const PluginElement& element, const Scene& scene) {
  if (element.body == kNoBody) return "the scene";
  return "body '" + scene.bodies[static_cast<std::size_t>(element.body)].name + "'";
}

/// Why a scene leaves out a plug-in that it could call for by an element.
std::string withoutItsElements(const Manifest& manifest) {
  std::string elements;
  for (const Manifest::Element& element : manifest.elements)
    elements += (elements.empty() ? "<" : ", <") + element.name + ">";
  return "the scene has no " + elements + ": " + manifest.about;
}

void planRenderer(const Scene& scene, Plan& plan) {
  const std::string &renderer = scene.haptics.renderer, &of_tools = scene.haptics.tool_renderer;
  if (scene.hasFingertips())
    plan.effects.push_back({renderer, "fingers meet bodies: <haptics renderer=\"" + renderer + "\">"});
  if (scene.hasTools()) plan.effects.push_back({of_tools, "tools meet bodies: <haptics tools=\"" + of_tools + "\">"});
}

/// The friction laws of the bodies that fingers can touch.
void planFriction(const Scene& scene, Plan& plan) {
  if (!scene.hasFingertips() || !scene.haptics.proxy) return;
  for (const Body& body : scene.bodies) {
    if (!body.haptic || !hasFriction(scene, body.material)) continue;
    const PluginElement law = frictionLawOf(scene, body.material);
    if (std::ranges::any_of(plan.effects, [&](const PlannedEffect& e) { return e.plugin == law.plugin; })) continue;
    const std::string& material = scene.materials[body.material].name;
    plan.effects.push_back({law.plugin, "material '" + material + "' has <" + law.element + ">"});
  }
}

void planSurfaceEffects(const Scene& scene, Plan& plan) {
  if (!scene.hasFingertips()) return;
  for (const PluginElement& effect : surfaceEffectsOf(scene)) {
    if (std::ranges::any_of(plan.effects, [&](const PlannedEffect& e) { return e.plugin == effect.plugin; })) continue;
    const auto own = std::ranges::find(scene.plugin_elements, effect.plugin, &PluginElement::plugin);
    const bool of_scene = own != scene.plugin_elements.end() && own->body == kNoBody && own->material < 0;
    plan.effects.push_back({effect.plugin, ownerOf(of_scene ? *own : effect, scene) + " has <" + effect.element + ">"});
  }
}

/// Adds the plug-ins of that kind whose elements the scene has.
void planElements(const Scene& scene, PluginKind kind, Plan& plan) {
  for (const PluginElement& element : scene.plugin_elements) {
    if (element.kind != kind) continue;
    if (kind == PluginKind::kBodyEffect && !actsOnFreeBody(scene, element)) continue;
    if (std::ranges::any_of(plan.effects, [&](const PlannedEffect& e) { return e.plugin == element.plugin; })) continue;
    plan.effects.push_back({element.plugin, ownerOf(element, scene) + " has <" + element.element + ">"});
  }
}

/// Why the scene does not call for that plug-in.
std::string whyNot(const Manifest& manifest, const Scene& scene) {
  const auto of_it = [&](const PluginElement& element) { return element.plugin == manifest.name; };
  const bool has_it = std::ranges::any_of(scene.plugin_elements, of_it);
  if (manifest.kind == PluginKind::kViewPart) return has_it ? "no view is wanted" : withoutItsElements(manifest);
  if (manifest.kind == PluginKind::kBodyEffect) return has_it ? "no free body has it" : withoutItsElements(manifest);
  if (scene.devices.empty()) return "the scene has no device";
  if (manifest.kind == PluginKind::kToolRenderer)
    return scene.hasTools() ? "the scene's tool renderer is '" + scene.haptics.tool_renderer + "'"
                            : "no device holds a tool";
  if (!scene.hasFingertips()) return "every device holds a tool";
  if (manifest.kind == PluginKind::kRenderer) return "the scene's renderer is '" + scene.haptics.renderer + "'";
  if (manifest.needs_proxy && !scene.haptics.proxy) return "the renderer '" + scene.haptics.renderer + "' has no proxy";
  if (!manifest.left_out.empty()) return manifest.left_out;
  if (has_it) return "nothing touchable needs it";
  return withoutItsElements(manifest);
}

/// Whether scenes call for plug-ins of that kind by an element or a name; modules are planned apart.
bool servesScenes(PluginKind kind) {
  using enum PluginKind;
  return kind != kModule && kind != kDevice && kind != kMethod && kind != kMetric;
}

/// What the scene could call for.
void leaveOutOthers(const Scene& scene, Plan& plan) {
  for (const Manifest& manifest : manifests()) {
    if (!servesScenes(manifest.kind)) continue;
    if (std::ranges::any_of(plan.effects, [&](const PlannedEffect& e) { return e.plugin == manifest.name; })) continue;
    plan.left_out.push_back({manifest.name, whyNot(manifest, scene)});
  }
}

/// Whether a run needs a module, and why or why not.
struct Need {
  bool wanted;
  std::string reason;
};

/// One alternative of <wanted>: the last fact says why, the first that does not hold says why not.
Need needOf(const std::vector<std::string>& together, const std::vector<SceneFact>& facts) {
  Need need{true, ""};
  for (const std::string& name : together) {
    const SceneFact& fact = *std::ranges::find(facts, name, &SceneFact::name);  // the manifest was checked
    if (!fact.holds) return {false, fact.why};
    need.reason = fact.why;
  }
  return need;
}

Need needOf(const Manifest& module, const Scene& scene, const std::vector<SceneFact>& facts) {
  if (!module.module.engine.empty() && module.module.engine != scene.dynamics.engine)
    return {false, "the scene's engine is '" + scene.dynamics.engine + "'"};
  Need need{false, ""};
  for (const std::vector<std::string>& together : module.module.wanted) {
    need = needOf(together, facts);
    if (need.wanted) return need;
  }
  const auto own = std::ranges::find(scene.plugin_elements, module.name, &PluginElement::plugin);
  if (own != scene.plugin_elements.end()) return {true, ownerOf(*own, scene) + " has <" + own->element + ">"};
  if (module.module.wanted.empty()) need.reason = withoutItsElements(module);
  return need;
}

/// The modules of the plug-in folders, by rate and name, so that the order of a graph depends on nothing else.
std::vector<const Manifest*> modulesByRate() {
  std::vector<const Manifest*> modules;
  for (const Manifest& manifest : manifests())
    if (manifest.kind == PluginKind::kModule) modules.push_back(&manifest);
  std::ranges::stable_sort(modules, {}, [](const Manifest* m) { return m->module.rate; });
  return modules;
}

/// "ode, other": engines for which `supports` is set.
std::string enginesThat(bool Manifest::ModuleRole::*supports) {
  std::string names;
  for (const Manifest* manifest : modulesByRate()) {
    const Manifest::ModuleRole& role = manifest->module;
    if (!role.engine.empty() && role.*supports) names += (names.empty() ? "" : ", ") + role.engine;
  }
  return names;
}

/// What the scene has and its engine does not support.
void checkEngine(const Scene& scene, const Plan& plan, Diagnostics& diagnostics) {
  const SourceLocation where{scene.file, 0, 0};
  for (const PlannedModule& planned : plan.modules) {
    const Manifest::ModuleRole& role = findManifest(planned.plugin)->module;
    if (role.engine.empty()) continue;
    if (!role.fingers && !scene.devices.empty())
      diagnostics.error(407, where, "the scene has devices, and " + planned.plugin + " does not support fingers",
                        "engines that do: " + enginesThat(&Manifest::ModuleRole::fingers));
    for (const PluginElement& element : scene.plugin_elements) {
      if (role.body_effects || element.kind != PluginKind::kBodyEffect || !actsOnFreeBody(scene, element)) continue;
      diagnostics.error(226, element.where,
                        "<" + element.element + "> is a body effect, which " + planned.plugin + " does not support",
                        "engines that do: " + enginesThat(&Manifest::ModuleRole::body_effects));
    }
    if (!role.joints && !scene.joints.empty())
      diagnostics.error(234, scene.joints[0].where,
                        "the scene has joints, and " + planned.plugin + " does not support them",
                        "engines that do: " + enginesThat(&Manifest::ModuleRole::joints));
    for (const PluginElement& element : scene.plugin_elements) {
      if (role.hits || !findManifest(element.plugin)->needs_hits) continue;
      diagnostics.error(kHits, element.where,
                        "<" + element.element + "> hears bodies that hit each other, and " + planned.plugin +
                            " does not say which do",
                        "engines that do: " + enginesThat(&Manifest::ModuleRole::hits));
    }
    if (!role.snap && scene.assembly)
      diagnostics.error(409, where,
                        "the scene has an assembly, and " + planned.plugin + " does not support snap constraints",
                        "engines that do: " + enginesThat(&Manifest::ModuleRole::snap));
  }
}

void planModules(const Scene& scene, const std::vector<SceneFact>& facts, Plan& plan) {
  for (const Manifest* manifest : modulesByRate()) {
    Need need = needOf(*manifest, scene, facts);
    if (need.wanted) {
      plan.modules.push_back({manifest->name, manifest->module.rate, std::move(need.reason)});
    } else {
      plan.left_out.push_back({manifest->name, std::move(need.reason)});
    }
  }
}

std::vector<std::string> framesAbove(const Rig& rig, const DeviceBinding& device) {
  std::vector<std::string> names;
  std::string at = device.frame;
  while (at != kWorldFrame) {
    names.push_back(at);
    const auto frame = std::ranges::find(rig.frames, at, &Frame::name);
    const auto tool = std::ranges::find(rig.devices, at, &DeviceBinding::role);
    at = frame != rig.frames.end() ? frame->parent : tool != rig.devices.end() ? tool->frame : kWorldFrame;
  }
  return names;
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
    devices.push_back({role.role, binding->driver, framesAbove(rig, *binding), zoomRange(rig, role.role).max});
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
  planModules(scene, factsOf(scene, rig, options), plan);
  checkEngine(scene, plan, diagnostics);
  if (options.realtime && scene.rates.haptic > kFastestRealTime) {
    diagnostics.error(408, {scene.file, 0, 0}, "a haptic rate above 10000 Hz cannot be kept against the clock",
                      "use --lockstep, in which finer steps serve as a reference for coarser ones");
  }
  planRenderer(scene, plan);
  if (scene.hasFingertips()) planElements(scene, PluginKind::kForceEffect, plan);
  planFriction(scene, plan);
  planSurfaceEffects(scene, plan);
  planElements(scene, PluginKind::kBodyEffect, plan);
  if (options.view != RunOptions::View::kNone) planElements(scene, PluginKind::kViewPart, plan);
  leaveOutOthers(scene, plan);
  return plan;
}

}  // namespace presa
