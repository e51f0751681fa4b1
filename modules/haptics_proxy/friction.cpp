#include <cmath>

#include "modules/haptics_proxy/finger_stage.h"
#include "modules/haptics_proxy/god_object.h"

namespace presa {

// The base of the cone is the frictionless point, its apex the HIP, its radius mu * depth.
void holdByFriction(ProxyContact& contact, const FingertipState& last, const Vec3& g, double r,
                    const FrictionCone& cone, Surroundings& surroundings) noexcept {
  if (!contact.state.touching) return;
  const Vec3 held = last.touching ? last.x : contact.first_touch;
  contact.state.hold = last.touching ? last.hold : contact.first_touch;
  Vec3 stretch = contact.state.hold - contact.state.god;
  stretch -= stretch.dot(contact.nhat) * contact.nhat;
  const double length = stretch.norm();
  const double mu = last.touching && last.slipping ? cone.mu_dynamic : cone.mu_static;
  contact.state.slipping = length > mu * contact.depth;
  if (contact.state.slipping) stretch *= cone.mu_dynamic * contact.depth / length;

  // what sticks does not move at all: it lives in the body's coordinates, so there is no drift to correct
  if (!contact.state.slipping && isSupported(held, r, surroundings)) {
    contact.state.x = held;
  } else {
    // the border of the cone is reached along the surface: move the goal sideways, and go there; also where the body that
    // friction held on to is gone
    contact.state.hold = g + stretch;
    const ProxyMove moved = moveProxy(held, contact.state.hold, r, surroundings);
    contact.covered = contact.covered && moved.covered;
    // no surface on the way: nothing bears the normal force there, so friction has nothing to hold on to
    const bool lost = moved.covered && !moved.touching;
    contact.state.slipping = contact.state.slipping || lost;
    contact.state.x = lost ? contact.state.god : moved.x;
    if (lost) contact.state.hold = contact.state.god;
  }
  contact.x = contact.state.x;
  const Vec3 away = contact.x - g;
  contact.depth = away.dot(contact.nhat);
  contact.stretch = away - contact.depth * contact.nhat;
}

namespace {

class Friction final : public FingerStage {
 public:
  explicit Friction(const Scene& scene) : scene_(scene) {}
  void apply(FingerTick& tick) noexcept override {
    if (!tick.contact.state.touching) return;
    const Material& material = scene_.materialOf(scene_.bodies[static_cast<std::size_t>(tick.contact.body)]);
    holdByFriction(tick.contact, tick.finger.tip, tick.g, tick.r, {material.friction_static, material.friction_dynamic},
                   *tick.finger.near);
    tick.out.friction_static = material.friction_static;
    tick.out.friction_dynamic = material.friction_dynamic;
  }
  const char* what() const override { return "friction: two-state cone"; }

 private:
  const Scene& scene_;
};

}  // namespace

std::unique_ptr<FingerStage> makeFriction(const World& world) { return std::make_unique<Friction>(world.scene); }

}  // namespace presa
