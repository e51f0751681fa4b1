#include "tests/support/body_effect_field.h"

#include "framework/haptics/body_effects.h"
#include "framework/scene/manifest.h"
#include "tests/support/finger_world.h"

namespace presa::test {
namespace {

std::shared_ptr<const World> cubeWith(const std::string& element) {
  const std::string name = element.substr(1, element.find_first_of(" />") - 1);
  const Manifest::Element* known = findElement(name);  // null: reading the scene reports it
  const bool in_body = known != nullptr && known->place == Manifest::Place::kBody;
  return fingerWorld(R"(<scene version="1.0" name="effect">)" + (in_body ? "" : element) +
                     R"(<world gravity="0 0 -9.81"/><materials><material name="any" stiffness="1000"/></materials>
    <body name="cube" material="any">)" +
                     (in_body ? element : "") +
                     R"(<physics mass="0.2"><box size="0.07 0.07 0.07"/></physics></body>
    <devices><device role="finger" fingertip_radius="0.008"/></devices></scene>)");
}

}  // namespace

struct BodyEffectField::Parts {
  explicit Parts(const std::string& element) : world(cubeWith(element)) {}
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
