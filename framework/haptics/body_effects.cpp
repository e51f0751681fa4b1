#include "framework/haptics/body_effects.h"

#include <algorithm>
#include <cmath>

#include "framework/haptics/plugin_object.h"

namespace presa {
namespace {

// A sum of several terms may exceed the bound by rounding.
constexpr double kBoundRounding = 1 + 1e-9;

std::unique_ptr<BodyEffect> makeEffect(const PluginElement& element, std::size_t bodies) {
  const auto& table = pluginTable<BodyEffectPlugin>(element.plugin, "presaBodyEffectPlugin");
  return madeFor(element, [&] { return table.create(element, bodies); });
}

bool isRate(double rate) { return rate >= 0 && std::isfinite(rate); }

// Comparisons are written so that NaN fails.
bool keepsContract(const BodyEffectWrench& wrench, double max_force, double max_torque) {
  const BodyEffectRates& rates = wrench.rates;
  return wrench.f_W.norm() <= max_force * kBoundRounding && wrench.torque_W.norm() <= max_torque * kBoundRounding &&
         isRate(rates.damping) && isRate(rates.stiffness) && isRate(rates.turn_damping) && isRate(rates.turn_stiffness);
}

}  // namespace

bool actsOnFreeBody(const Scene& scene, const PluginElement& element) {
  if (element.body == kNoBody) return std::ranges::any_of(scene.bodies, [](const Body& body) { return !body.fixed; });
  return !scene.bodies[static_cast<std::size_t>(element.body)].fixed;
}

bool hasBodyEffects(const Scene& scene) {
  return std::ranges::any_of(scene.plugin_elements, [&](const PluginElement& element) {
    return element.kind == PluginKind::kBodyEffect && actsOnFreeBody(scene, element);
  });
}

BodyEffects::BodyEffects(const World& world) {
  const Scene& scene = world.scene;
  for (const PluginElement& element : scene.plugin_elements) {
    if (element.kind != PluginKind::kBodyEffect || !actsOnFreeBody(scene, element)) continue;
    effects_.push_back({makeEffect(element, scene.bodies.size()), nameOf(element, scene), boundOf(element, "max_force"),
                        boundOf(element, "max_torque"), element.body});
  }
}

BodyEffectWrench BodyEffects::apply(std::size_t effect, const BodyEffectInput& input) noexcept {
  if (broken()) return {};
  const Effect& one = effects_[effect];
  const BodyEffectWrench wrench = one.effect->apply(input);
  if (keepsContract(wrench, one.max_force, one.max_torque)) [[likely]]
    return wrench;
  broken_.store(static_cast<int>(effect), std::memory_order_release);
  return {};
}

std::vector<std::string> BodyEffects::names() const {
  std::vector<std::string> names;
  for (const Effect& effect : effects_) names.push_back(effect.name);
  return names;
}

std::optional<std::string> BodyEffects::brokenName() const {
  const int broken = broken_.load(std::memory_order_acquire);
  if (broken < 0) return std::nullopt;
  return "body effect " + effects_[static_cast<std::size_t>(broken)].name;
}

}  // namespace presa
