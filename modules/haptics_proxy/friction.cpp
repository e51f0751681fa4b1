// Friction on the god-object (PERCRO paper, section 3.3). The law (framework/haptics/friction_law.h) says how far the
// proxy may lag behind the frictionless point; this file moves the proxy there. A sticking proxy is not moved at all. The
// tangential displacement is stored at the HIP (state.stick_anchor), not recomputed from the proxy, which would drift on
// curved surfaces. Invariants: a touching proxy lies on a surface, and every motion of it is swept (moveProxy).
#include <array>
#include <atomic>
#include <cmath>
#include <vector>

#include "framework/haptics/friction_laws.h"

#include "modules/haptics_proxy/finger_stage.h"
#include "modules/god_object/god_object.h"

namespace presa {

namespace {

/// Restarts both points from the fingertip at `x`, without friction. Needed where the frictionless point took another
/// path, round an edge or out of a fold that the fingertip is still in.
void startAgainFrom(const Vec3& x, const Vec3& g, double r, ProxyContact& contact,
                    Surroundings& surroundings) noexcept {
  const ProxyMove free = moveProxy(x, g, r, surroundings);
  contact.state.x = contact.state.god_object = contact.state.stick_anchor = free.x;
  contact.state.touching = contact.state.slipping = free.touching;
  contact.state.fresh = true;
  contact.depth = free.touching ? (free.x - g).norm() : 0;
  contact.body = free.body;
  contact.first_touch = free.first_touch;
  contact.active = free.active;
  if (contact.depth > 0) contact.nhat = (free.x - g) / contact.depth;
}

constexpr double kSameSide = 0.5;  // minimum cosine between normals on the same side of a body

/// The law's answer for a contact whose tangential displacement is `displacement` if the proxy sticks.
FrictionAnswer ask(const Friction& friction, ProxyContact& contact, const FingertipState& last, const Vec3& g,
                   const Vec3& displacement) noexcept {
  const bool fresh = !last.touching || last.fresh;
  contact.state.fresh = false;
  contact.state.g = g;
  contact.state.friction = fresh ? FrictionState{} : last.friction;
  Vec3 slide = fresh ? Vec3(-displacement) : Vec3(g - last.g);
  slide -= slide.dot(contact.nhat) * contact.nhat;
  return friction.law.hold(
      {friction.period, fresh, last.touching && last.slipping, friction.mu_static, friction.mu_dynamic,
       friction.stiffness, contact.depth, contact.nhat, displacement, slide, friction.q_BA},
      contact.state.friction);
}

bool meets(const Vec3& a, const Vec3& b, double r) noexcept {
  constexpr double kSame = 1e-4;  // relative to r: accuracy of two motions to the same point
  return (a - b).norm() <= kSame * r;
}

}  // namespace

bool holdByFriction(ProxyContact& contact, const FingertipState& last, const Vec3& g, double r,
                    const Friction& friction, Surroundings& surroundings, FrictionAnswer& answer) noexcept {
  if (!contact.state.touching && !last.touching) return true;
  surroundings.use(Point::kHeld);
  if (!contact.state.touching) {
    // no contact: the fingertip follows the frictionless point, if a path leads there
    const ProxyMove back = moveProxy(last.x, contact.state.god_object, r, surroundings);
    if (!meets(back.x, contact.state.god_object, r)) startAgainFrom(back.x, g, r, contact, surroundings);
    contact.x = contact.state.x;
    if (!contact.state.touching) return true;
    // a contact that begins here: nothing is stretched yet, but the dynamics needs the law's bounds
    answer = ask(friction, contact, FingertipState{}, g, Vec3::Zero());
    return keepsContract(answer, contact.depth);
  }
  const Vec3 held = last.touching ? last.x : contact.first_touch;
  contact.state.stick_anchor = last.touching ? last.stick_anchor : contact.first_touch;
  Vec3 displacement = contact.state.stick_anchor - contact.state.god_object;
  displacement -= displacement.dot(contact.nhat) * contact.nhat;
  answer = ask(friction, contact, last, g, displacement);
  const Vec3& stretch = answer.stretch;
  if (!keepsContract(answer, contact.depth)) return false;
  contact.state.slipping = answer.slipping;

  // a sticking proxy stays fixed in the body's coordinates, so there is no drift to correct
  if (!contact.state.slipping && stretch == displacement && isSupported(held, r, surroundings)) {
    contact.state.x = held;
  } else {
    // move the goal sideways to where the law allows it and move the proxy there; also when the body that friction held
    // on to is gone
    contact.state.stick_anchor = g + stretch;
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
  return true;
}

namespace {

/// The laws of the scene, and what both stages below do with them.
class LawStage : public FrictionStage {
 public:
  explicit LawStage(const SurfacesInForce& surfaces) : surfaces_(surfaces), laws_(surfaces.scene) {}

  std::optional<std::string> brokenLaw() const override {
    const int body = broken_.load(std::memory_order_acquire);
    if (body < 0) return std::nullopt;
    const Material& material = surfaces_.scene.materialOf(surfaces_.scene.bodies[static_cast<std::size_t>(body)]);
    return "friction law '" + laws_.nameOf(body) + "' of material '" + material.name + "'";
  }

 protected:
  static std::int32_t bodyOf(const FingerTick& tick) noexcept {
    return tick.contact.body != kNoBody ? tick.contact.body : tick.finger.frame;
  }
  void hold(FingerTick& tick, std::int32_t body, double mu_static, double mu_dynamic) noexcept {
    Friction friction{*laws_.of(body), mu_static, mu_dynamic, surfaces_.of(body).stiffness, tick.period};
    if (body != tick.finger.frame) friction.q_BA = tick.touchables.frameOf(body).q.conjugate() * tick.X_WA.q;
    FrictionAnswer answer;
    if (!holdByFriction(tick.contact, tick.finger.tip, tick.g, tick.r, friction, *tick.finger.near, answer)) {
      int none = -1;
      broken_.compare_exchange_strong(none, body, std::memory_order_acq_rel);
    }
    tick.broken = broken_.load(std::memory_order_relaxed) >= 0;
    if (!tick.contact.state.touching) return;
    tick.out.friction_static = answer.bound;
    tick.out.friction_dynamic = answer.bound_sliding;
    tick.out.tangential_ratio = answer.ratio;
    tick.out.tangential_damping = answer.damping;
    if (answer.damping > 0) tick.out.damped_W = tick.X_WA.q * answer.damped;
  }
  std::string names() const {
    std::string all;
    for (const std::string& name : laws_.names()) all += (all.empty() ? "" : ", ") + name;
    return all;
  }
  const SurfacesInForce surfaces_;

 private:
  const FrictionLaws laws_;
  std::atomic<int> broken_{-1};  // body
};

class SteadyFriction final : public LawStage {
 public:
  using LawStage::LawStage;
  void apply(FingerTick& tick) noexcept override {
    const std::int32_t body = bodyOf(tick);
    if (body == kNoBody) return;
    const Material& material = surfaces_.of(body);
    hold(tick, body, material.friction_static, material.friction_dynamic);
  }
  std::string what() const override { return "friction: " + names(); }
};

/// Uses the changed coefficients from the tick of the change on; a sticking finger outside the new bound then slips.
class ChangingFriction final : public LawStage {
 public:
  ChangingFriction(const SurfacesInForce& surfaces, const In<SurfaceChange>& change)
      : LawStage(surfaces), change_(change) {
    for (const Body& body : surfaces.scene.bodies) {
      const Material& material = surfaces.scene.materialOf(body);
      const FrictionCoefficients before{material.friction_static, material.friction_dynamic};
      coefficients_.push_back({before, material.changed_friction.value_or(before)});
    }
  }
  void apply(FingerTick& tick) noexcept override {
    const std::int32_t body = bodyOf(tick);
    if (body == kNoBody) return;
    const FrictionCoefficients& now = coefficients_[static_cast<std::size_t>(body)][change_->happened ? 1 : 0];
    hold(tick, body, now.mu_static, now.mu_dynamic);
  }
  std::string what() const override {
    return "friction: " + names() + ", with other coefficients after the surface change";
  }

 private:
  std::vector<std::array<FrictionCoefficients, 2>> coefficients_;  // by body: before and after
  const In<SurfaceChange>& change_;
};

}  // namespace

std::unique_ptr<FrictionStage> makeFriction(const SurfacesInForce& surfaces) {
  return std::make_unique<SteadyFriction>(surfaces);
}
std::unique_ptr<FrictionStage> makeChangingFriction(const SurfacesInForce& surfaces, const In<SurfaceChange>& change) {
  return std::make_unique<ChangingFriction>(surfaces, change);
}

}  // namespace presa
