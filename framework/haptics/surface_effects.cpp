#include "framework/haptics/surface_effects.h"

#include <algorithm>
#include <cmath>

#include "framework/geometry/rotation_between.h"
#include "framework/haptics/plugin_object.h"
#include "framework/scene/manifest.h"

namespace presa {
namespace {

constexpr double kMinCosine = 0.5;               // of the angle by which effects may turn a force
constexpr double kStiffnessRounding = 1 + 1e-9;  // a stiffness may exceed its bound by rounding

bool needsProxy(const std::string& plugin) {
  const Manifest* manifest = findManifest(plugin);
  return manifest != nullptr && manifest->needs_proxy;
}

}  // namespace

std::unique_ptr<SurfaceEffect> makeSurfaceEffect(const PluginElement& element, const World& world) {
  const auto& table = pluginTable<SurfaceEffectPlugin>(element.plugin, "presaSurfaceEffectPlugin");
  return madeFor(element, [&] { return table.create(element, world); });
}

std::vector<PluginElement> surfaceEffectsOf(const Scene& scene) {
  std::vector<PluginElement> all;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    if (!body.haptic) continue;
    const auto index = static_cast<std::int32_t>(b);
    for (const PluginElement& element : scene.plugin_elements) {
      const bool of_scene = element.body == kNoBody && element.material < 0;
      const bool of_it =
          of_scene || element.body == index || element.material == static_cast<std::int32_t>(body.material);
      if (element.kind != PluginKind::kSurfaceEffect || !of_it) continue;
      all.push_back(element);
      all.back().body = index;
    }
    if (body.haptic->smooth && std::holds_alternative<MeshRef>(body.haptic->shape))
      all.push_back({kShading, "haptic shading=\"smooth\"", index, {}, {scene.file, 0, 0}, PluginKind::kSurfaceEffect});
  }
  if (!scene.haptics.proxy) std::erase_if(all, [](const PluginElement& element) { return needsProxy(element.plugin); });
  return all;
}

SurfaceEffects::SurfaceEffects(const World& world) : of_body_(world.scene.bodies.size()) {
  for (const PluginElement& element : surfaceEffectsOf(world.scene)) {
    const auto body = static_cast<std::size_t>(element.body);
    of_body_[body].push_back({makeSurfaceEffect(element, world), "surface effect <" + element.element + "> of body '" +
                                                                     world.scene.bodies[body].name + "'"});
  }
}

// Turns the contact's normal. True if it changed.
bool SurfaceEffects::turn(const SurfaceInput& input, ProxyContact& contact) noexcept {
  Vec3 sum = Vec3::Zero();
  bool changed = false;
  for (int i = 0; i < contact.active.count; ++i) {
    const ActiveSet::Member& member = contact.active.member[static_cast<std::size_t>(i)];
    Vec3 nhat = member.nhat;
    for (const Effect& each : of_body_[static_cast<std::size_t>(member.body)])
      nhat = each.effect->normal(input, member, nhat);
    changed = changed || nhat != member.nhat;
    sum += member.weight * nhat;
  }
  const double length = sum.norm();
  if (!changed || !(length > 0) || !(sum.dot(contact.nhat) > kMinCosine * length)) return false;
  const Quat turn = rotationBetween(contact.nhat, sum);
  contact.nhat = sum / length;
  contact.tangential_displacement = turn * contact.tangential_displacement;
  return true;
}

// Of several the first one.
void SurfaceEffects::breaks(const Effect& effect) noexcept {
  const Effect* none = nullptr;
  broken_.compare_exchange_strong(none, &effect, std::memory_order_acq_rel);
}

bool SurfaceEffects::changeFriction() const {
  return std::ranges::any_of(of_body_, [](const std::vector<Effect>& effects) {
    return std::ranges::any_of(effects, [](const Effect& each) { return each.effect->changesFriction(); });
  });
}

double SurfaceEffects::friction(const SurfaceInput& input) noexcept {
  double share = 1;
  for (const Effect& each : of_body_[static_cast<std::size_t>(input.contact.body)]) {
    const double here = each.effect->friction(input);
    if (here >= 0 && here <= 1)
      share *= here;
    else
      breaks(each);  // NaN too
  }
  return share;
}

// False: an effect broke its contract, now or before.
bool SurfaceEffects::apply(std::int32_t body, const SurfaceInput& input, SurfaceContact& contact) noexcept {
  const double stiffness = contact.stiffness;
  for (const Effect& each : of_body_[static_cast<std::size_t>(body)]) {
    each.effect->apply(input, contact);
    const double sum = contact.depth + contact.nhat.sum() + contact.tangential.sum();
    if (std::isfinite(sum) && contact.stiffness >= 0 && contact.stiffness <= kStiffnessRounding * stiffness) continue;
    breaks(each);
  }
  return broken_.load(std::memory_order_relaxed) == nullptr;
}

bool SurfaceEffects::act(const SurfaceInput& input, double stiffness, ProxyContact& contact,
                         double& softness) noexcept {
  const bool turned = turn(input, contact);
  const SurfaceContact before{contact.nhat, contact.depth, contact.tangential_displacement, stiffness};
  SurfaceContact after = before;
  if (!apply(contact.body, input, after)) return false;
  softness = after.stiffness / stiffness;
  const bool moved = after.depth != before.depth || after.nhat != before.nhat || after.tangential != before.tangential;
  if (!turned && !moved) return true;
  // friction stays across the normal and below its bound; while it slips it is at its bound
  if (after.nhat != before.nhat) after.tangential = rotationBetween(before.nhat, after.nhat) * after.tangential;
  if (contact.state.slipping || after.depth < before.depth)
    after.tangential *= std::max(0.0, after.depth) / before.depth;
  contact.nhat = after.nhat;
  contact.depth = after.depth;
  contact.tangential_displacement = after.tangential;
  contact.x = input.g + contact.depth * contact.nhat + contact.tangential_displacement;
  return true;
}

std::vector<std::string> SurfaceEffects::descriptions() const {
  std::vector<std::string> all;
  for (const auto& effects : of_body_) {
    for (const Effect& each : effects) {
      std::string what = each.effect->what();
      if (std::ranges::find(all, what) == all.end()) all.push_back(std::move(what));
    }
  }
  return all;
}

std::string SurfaceEffects::broken() const {
  const Effect* broken = broken_.load(std::memory_order_acquire);
  return broken == nullptr ? std::string{} : broken->name;
}

}  // namespace presa
