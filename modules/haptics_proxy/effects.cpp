#include "modules/haptics_proxy/effects.h"

#include <algorithm>

#include "framework/haptics/friction_laws.h"
#include "framework/haptics/surface_effects.h"
#include "framework/scene/open_surfaces.h"

namespace presa {

HapticEffects effectsOf(const World& world, const RunOptions& options) {
  const Scene& scene = world.scene;
  const auto any_touchable = [&](const auto& wanted) {
    return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                       [&](const Body& body) { return body.haptic && wanted(body); });
  };
  HapticEffects effects;
  effects.renderer = scene.haptics.renderer;
  effects.proxy = scene.haptics.proxy;
  const bool effect_on_free_body = std::ranges::any_of(scene.plugin_elements, [&](const PluginElement& element) {
    return element.kind == PluginKind::kForceEffect && element.body != kNoBody &&
           !scene.bodies[static_cast<std::size_t>(element.body)].fixed;
  });
  if (effect_on_free_body || any_touchable([](const Body& body) { return !body.fixed; })) {
    effects.poses = scene.haptics.pose == HapticSettings::PoseUse::kHold ? HapticEffects::Poses::kHold
                                                                         : HapticEffects::Poses::kInterpolate;
  }
  effects.surface_change = scene.surfacesChange();
  effects.friction =
      effects.surface_change ||
      (effects.proxy && any_touchable([&](const Body& body) { return hasFriction(scene, body.material); }));
  effects.commanded = options.bus_commands && !openSurfaces(scene).empty();
  effects.surface_effects = !surfaceEffectsOf(scene).empty();
  effects.hits = effects.surface_effects && needsBodyHits(scene);
  effects.damping = any_touchable([&](const Body& body) { return scene.materialOf(body).damping > 0; });
  effects.torsion =
      effects.friction && any_touchable([&](const Body& body) { return scene.materialOf(body).torsional_radius > 0; });
  effects.held = effects.poses != HapticEffects::Poses::kNone &&
                 scene.dynamics.coupling == DynamicsSettings::Coupling::kHapticRate;
  effects.impulse = scene.dynamics.coupling == DynamicsSettings::Coupling::kAveraged;
  return effects;
}

std::vector<LeftOut> effectsLeftOut(const HapticEffects& effects) {
  const std::string renderer = "the renderer '" + effects.renderer + "' has no proxy ";
  std::vector<LeftOut> left_out;
  if (effects.poses == HapticEffects::Poses::kNone) left_out.push_back({"moving bodies", "nothing touchable moves"});
  if (!effects.friction) {
    left_out.push_back(
        {"friction", effects.proxy ? "no touchable material has friction" : renderer + "that friction holds"});
  }
  if (!effects.surface_change) {
    left_out.push_back({"changing friction", effects.proxy ? "no touchable material has <changed> friction"
                                                           : renderer + "that friction holds"});
  }
  if (!effects.commanded) left_out.push_back({"commanded surfaces", "the run takes no commands (--bus-commands)"});
  if (!effects.damping) left_out.push_back({"surface damping", "no touchable material has damping"});
  if (!effects.torsion) left_out.push_back({"torsional friction", "no touchable material with friction has torsion"});
  return left_out;
}

}  // namespace presa
