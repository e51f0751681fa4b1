#include "tests/support/body_effect_field.h"

#include "framework/haptics/body_effects.h"
#include "tests/support/finger_world.h"

namespace presa::test {

struct BodyEffectField::Parts {
  explicit Parts(const std::string& element) : world(elementWorld(element, "0 0 -9.81")) {}
  std::shared_ptr<const World> world;
  BodyEffects effects{*world};
};

BodyEffectField::BodyEffectField(const std::string& element) : parts_(std::make_unique<Parts>(element)) {}
BodyEffectField::~BodyEffectField() = default;

BodyEffectWrench BodyEffectField::at(BodyEffectInput state) noexcept {
  constexpr double kStep = 0.005;  // [s] of the usual 200 Hz
  const BodyInertia& cube = parts_->world->inertias[0];
  state.body = 0;
  state.step = kStep;
  state.mass = cube.mass;
  state.inertia_B = cube.inertia;
  state.gravity_W = parts_->world->scene.gravity;
  return parts_->effects.apply(0, state);
}

bool BodyEffectField::broken() const noexcept { return parts_->effects.broken(); }

}  // namespace presa::test
