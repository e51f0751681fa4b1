// Two-state Coulomb friction on the god-object (PERCRO paper, section 3.3, figure 10). Cone: base at the frictionless
// god-object, apex at the HIP, radius mu * depth, with mu static while sticking and dynamic while slipping. A sticking
// proxy is not moved at all; a slipping one is moved to the border of the cone. The tangential displacement is stored
// at the HIP (state.stick_anchor), not recomputed from the proxy, which would drift on curved surfaces. Invariants: a
// touching proxy lies on a surface, and every motion of it is swept (moveProxy).
#include <array>
#include <cmath>
#include <vector>

#include "modules/haptics_proxy/finger_stage.h"
#include "modules/haptics_proxy/god_object.h"

namespace presa {

namespace {

/// Restarts both points from the fingertip at `x`, without friction. Needed where the frictionless point took another
/// path, round an edge or out of a fold that the fingertip is still in.
void startAgainFrom(const Vec3& x, const Vec3& g, double r, ProxyContact& contact,
                    Surroundings& surroundings) noexcept {
  const ProxyMove free = moveProxy(x, g, r, surroundings);
  contact.state.x = contact.state.god_object = contact.state.stick_anchor = free.x;
  contact.state.touching = contact.state.slipping = free.touching;
  contact.depth = free.touching ? (free.x - g).norm() : 0;
  contact.body = free.body;
  contact.first_touch = free.first_touch;
  contact.active = free.active;
  if (contact.depth > 0) contact.nhat = (free.x - g) / contact.depth;
}

constexpr double kSameSide = 0.5;  // minimum cosine between normals on the same side of a body

bool meets(const Vec3& a, const Vec3& b, double r) noexcept {
  constexpr double kSame = 1e-4;  // relative to r: accuracy of two motions to the same point
  return (a - b).norm() <= kSame * r;
}

}  // namespace

// The base of the cone is the frictionless point, its apex the HIP, its radius mu * depth.
void holdByFriction(ProxyContact& contact, const FingertipState& last, const Vec3& g, double r,
                    const FrictionCone& cone, Surroundings& surroundings) noexcept {
  if (!contact.state.touching && !last.touching) return;
  surroundings.use(Point::kHeld);
  if (!contact.state.touching) {
    // no contact: the fingertip follows the frictionless point, if a path leads there
    const ProxyMove back = moveProxy(last.x, contact.state.god_object, r, surroundings);
    if (!meets(back.x, contact.state.god_object, r)) startAgainFrom(back.x, g, r, contact, surroundings);
    contact.x = contact.state.x;
    return;
  }
  const Vec3 held = last.touching ? last.x : contact.first_touch;
  contact.state.stick_anchor = last.touching ? last.stick_anchor : contact.first_touch;
  Vec3 displacement = contact.state.stick_anchor - contact.state.god_object;
  displacement -= displacement.dot(contact.nhat) * contact.nhat;
  const double length = displacement.norm();
  const double mu = last.touching && last.slipping ? cone.mu_dynamic : cone.mu_static;
  contact.state.slipping = length > mu * contact.depth;
  if (contact.state.slipping) displacement *= cone.mu_dynamic * contact.depth / length;

  // a sticking proxy stays fixed in the body's coordinates, so there is no drift to correct
  if (!contact.state.slipping && isSupported(held, r, surroundings)) {
    contact.state.x = held;
  } else {
    // move the goal sideways to the border of the cone and move the proxy there; also when the body that friction held
    // on to is gone
    contact.state.stick_anchor = g + displacement;
    const ProxyMove moved = moveProxy(held, contact.state.stick_anchor, r, surroundings);
    contact.state.x = moved.x;
    const Vec3 normal = moved.x - contact.state.stick_anchor;
    if (!moved.touching) {
      // no surface on the path, hence no normal force and no friction
      contact.state.slipping = true;
      contact.state.stick_anchor = contact.state.god_object;
      const ProxyMove back = moveProxy(moved.x, contact.state.god_object, r, surroundings);
      contact.state.x = contact.state.god_object;
      if (!meets(back.x, contact.state.god_object, r)) startAgainFrom(back.x, g, r, contact, surroundings);
    } else if (normal.dot(contact.nhat) < kSameSide * normal.norm()) {
      startAgainFrom(moved.x, g, r, contact, surroundings);
    }
  }
  contact.x = contact.state.x;
  const Vec3 away = contact.x - g;
  contact.depth = away.dot(contact.nhat);
  contact.tangential_displacement = away - contact.depth * contact.nhat;
}

namespace {

void applyFriction(FingerTick& tick, const FrictionCone& cone) noexcept {
  holdByFriction(tick.contact, tick.finger.tip, tick.g, tick.r, cone, *tick.finger.near);
  if (!tick.contact.state.touching) return;
  tick.out.friction_static = cone.mu_static;
  tick.out.friction_dynamic = cone.mu_dynamic;
}

FrictionCone coneOf(const Material& material) { return {material.friction_static, material.friction_dynamic}; }

class Friction final : public FingerStage {
 public:
  explicit Friction(const SurfacesInForce& surfaces) : surfaces_(surfaces) {}
  void apply(FingerTick& tick) noexcept override {
    const std::int32_t body = tick.contact.body != kNoBody ? tick.contact.body : tick.finger.frame;
    if (body == kNoBody) return;
    applyFriction(tick, coneOf(surfaces_.of(body)));
  }
  const char* what() const override { return "friction: two-state cone"; }

 private:
  const SurfacesInForce surfaces_;
};

/// Uses the changed cone from the tick of the change on; a sticking finger outside the new cone then slips.
class ChangingFriction final : public FingerStage {
 public:
  ChangingFriction(const Scene& scene, const In<SurfaceChange>& change) : change_(change) {
    for (const Body& body : scene.bodies) {
      const FrictionCone before = coneOf(scene.materialOf(body));
      const auto& after = scene.materialOf(body).changed_friction;
      cones_.push_back({before, after ? FrictionCone{after->mu_static, after->mu_dynamic} : before});
    }
  }
  void apply(FingerTick& tick) noexcept override {
    const std::int32_t body = tick.contact.body != kNoBody ? tick.contact.body : tick.finger.frame;
    if (body == kNoBody) return;
    applyFriction(tick, cones_[static_cast<std::size_t>(body)][change_->happened ? 1 : 0]);
  }
  const char* what() const override {
    return "friction: two-state cone, with other coefficients after the surface change";
  }

 private:
  std::vector<std::array<FrictionCone, 2>> cones_;  // by body: before and after
  const In<SurfaceChange>& change_;
};

}  // namespace

std::unique_ptr<FingerStage> makeFriction(const SurfacesInForce& surfaces) {
  return std::make_unique<Friction>(surfaces);
}
std::unique_ptr<FingerStage> makeChangingFriction(const World& world, const In<SurfaceChange>& change) {
  return std::make_unique<ChangingFriction>(world.scene, change);
}

}  // namespace presa
