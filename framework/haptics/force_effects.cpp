#include "framework/haptics/force_effects.h"

#include <algorithm>
#include <limits>

#include "framework/haptics/plugin_object.h"

namespace presa {
namespace {

// A sum of several terms may exceed the bound by rounding.
constexpr double kForceRounding = 1 + 1e-9;

std::unique_ptr<ForceEffect> makeForce(const PluginElement& element, std::size_t tools) {
  const auto& table = pluginTable<ForceEffectPlugin>(element.plugin, "presaForceEffectPlugin");
  return madeFor(element, [&] { return table.create(element, tools); });
}

}  // namespace

ForceEffects::ForceEffects(const World& world) {
  const Scene& scene = world.scene;
  for (const PluginElement& element : scene.plugin_elements) {
    if (element.kind != PluginKind::kForceEffect) continue;
    Effect effect{makeForce(element, scene.devices.size()), nameOf(element, scene), boundOf(element, "max_force"),
                  boundOf(element, "max_torque"), element.body};
    if (element.body != kNoBody && !scene.bodies[static_cast<std::size_t>(element.body)].fixed) {
      const auto known = std::find(moving_.begin(), moving_.end(), element.body);
      effect.slot = static_cast<std::int32_t>(known - moving_.begin());
      if (known == moving_.end()) moving_.push_back(element.body);
    }
    effects_.push_back(std::move(effect));
  }
}

EffectReactions ForceEffects::reactions() const {
  EffectReactions reactions;
  for (const std::int32_t body : moving_) reactions.bodies.push_back({.body = body});
  return reactions;
}

std::vector<std::string> ForceEffects::names() const {
  std::vector<std::string> names;
  for (const Effect& effect : effects_) names.push_back(effect.name);
  return names;
}

void ForceEffects::apply(std::size_t tool, const Tick& tick, const FingerInput& input, double radius,
                         const Touchables& touchables, FingerContact& out, EffectReactions& reactions) noexcept {
  for (std::size_t i = 0; i < effects_.size(); ++i) {
    Effect& effect = effects_[i];
    const Pose X_WB = touchables.frameOf(effect.body);
    const EffectForce force = effect.effect->apply(
        tool, {tick.time, tick.period, input.p_WH, input.v_WH, radius, X_WB, input.oriented, input.q_WT, input.w_WT});
    // written so that NaN fails
    if (!(force.f_T_W.norm() <= effect.max_force * kForceRounding && force.p_WF.allFinite() &&
          force.couple_T_W.norm() <= effect.max_torque * kForceRounding)) {
      int none = -1;
      broken_.compare_exchange_strong(none, static_cast<int>(i), std::memory_order_acq_rel);
      break;
    }
    out.f_H_W += force.f_T_W;
    if (input.oriented) out.t_H_W += force.couple_T_W + (force.p_WF - input.p_WH).cross(force.f_T_W);
    react(effect, force, X_WB, input.oriented, tick.period, reactions);
  }
  if (broken() >= 0) out.f_H_W.setConstant(std::numeric_limits<double>::quiet_NaN());
}

void ForceEffects::react(const Effect& effect, const EffectForce& force, const Pose& X_WB, bool oriented, double period,
                         EffectReactions& reactions) const noexcept {
  if (effect.slot < 0) return;
  EffectReactions::OnBody& on = reactions.bodies[static_cast<std::size_t>(effect.slot)];
  on.impulse_W -= period * force.f_T_W;
  on.angular_impulse_W -= period * (force.p_WF - X_WB.p).cross(force.f_T_W);
  if (oriented) on.angular_impulse_W -= period * force.couple_T_W;
}

}  // namespace presa
