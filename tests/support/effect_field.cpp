#include "tests/support/effect_field.h"

#include "framework/haptics/force_effects.h"
#include "framework/scene/manifest.h"
#include "tests/support/finger_world.h"

namespace presa::test {
namespace {

bool standsInBody(const std::string& element) {
  const std::string name = element.substr(1, element.find_first_of(" />") - 1);
  const Manifest::Element* known = findElement(name);
  return known != nullptr && known->place == Manifest::Place::kBody;  // null: reading the scene reports it
}

std::shared_ptr<const World> worldWith(const std::string& element) {
  const bool in_body = standsInBody(element);
  const std::string scene = R"(<scene version="1.0" name="effect">)" + (in_body ? "" : element) +
                            R"(<world gravity="0 0 0"/><materials><material name="any" stiffness="1000"/></materials>
    <body name="cube" material="any">)" +
                            (in_body ? element : "") +
                            R"(<physics mass="0.2"><box size="0.07 0.07 0.07"/></physics></body>
    <devices><device role="finger" fingertip_radius="0.008"/></devices></scene>)";
  return fingerWorld(scene);
}

}  // namespace

struct EffectField::Parts {
  explicit Parts(const std::string& element) : world(worldWith(element)) {}
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
