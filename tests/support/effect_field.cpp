#include "tests/support/effect_field.h"

#include "framework/haptics/force_effects.h"
#include "tests/support/finger_world.h"

namespace presa::test {
struct EffectField::Parts {
  explicit Parts(const std::string& element) : world(elementWorld(element)) {}
  std::shared_ptr<const World> world;
  ForceEffects effects{*world};
  Touchables touchables{*world};
  EffectReactions reactions = effects.reactions();
};

EffectField::EffectField(const std::string& element) : parts_(std::make_unique<Parts>(element)) {}
EffectField::~EffectField() = default;

Vec3 EffectField::force(const Vec3& p_WT, const Vec3& v_WT) noexcept { return wrench({p_WT, v_WT}).f; }

Wrench EffectField::wrench(const FingerInput& tool) noexcept {
  FingerContact out;
  FingerInput input = tool;
  input.valid = true;
  parts_->effects.apply(0, Tick{0, 0, 1e-3}, input, parts_->world->scene.devices[0].fingertip_radius,
                        parts_->touchables, out, parts_->reactions);
  return {out.f_H_W, out.t_H_W};
}

Vec3 EffectField::impulse() const noexcept {
  return parts_->reactions.bodies.empty() ? Vec3::Zero().eval() : parts_->reactions.bodies[0].impulse_W;
}

Vec3 EffectField::angularImpulse() const noexcept {
  return parts_->reactions.bodies.empty() ? Vec3::Zero().eval() : parts_->reactions.bodies[0].angular_impulse_W;
}

}  // namespace presa::test
