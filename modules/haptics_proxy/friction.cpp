// Friction on the god-object (PERCRO paper, section 3.3). The law (framework/haptics/friction_law.h) says how far the
// proxy may lag behind the frictionless point; this file moves the proxy there. A sticking proxy is not moved at all. The
// tangential displacement is stored at the HIP (state.stick_anchor), not recomputed from the proxy, which would drift on
// curved surfaces. Invariants: a touching proxy lies on a surface, and every motion of it is swept (ProxyMover).
#include "modules/haptics_proxy/friction.h"

#include <array>
#include <atomic>
#include <vector>

#include "framework/haptics/friction_laws.h"
#include "modules/haptics_proxy/finger_stage.h"

namespace presa {
namespace {

/// One finger in one tick.
struct Holding {
  ProxyContact& contact;
  const Vec3& g;
  double r;
  const ProxyMover& mover;
  Surroundings& near;

  ProxyMove move(const Vec3& from, const Vec3& to) const noexcept { return mover.move(from, to, r, near); }
};

/// Restarts both points from the fingertip at `x`, without friction. Needed where the frictionless point took another
/// path, round an edge or out of a fold that the fingertip is still in.
void startAgainFrom(const Vec3& x, const Holding& now, Held& held) noexcept {
  const ProxyMove free = now.move(x, now.g);
  ProxyContact& contact = now.contact;
  contact.state.x = contact.state.god_object = held.stick_anchor = free.x;
  contact.state.touching = contact.state.slipping = free.touching;
  held.fresh = true;
  contact.depth = free.touching ? (free.x - now.g).norm() : 0;
  contact.body = free.body;
  contact.first_touch = free.first_touch;
  contact.active = free.active;
  if (contact.depth > 0) contact.nhat = (free.x - now.g) / contact.depth;
}

constexpr double kSameSide = 0.5;  // minimum cosine between normals on the same side of a body

/// The law's answer for a contact whose tangential displacement is `displacement` if the proxy sticks.
FrictionAnswer ask(const Friction& friction, const Holding& now, bool fresh, bool slipped, Held& held,
                   const Vec3& displacement) noexcept {
  const ProxyContact& contact = now.contact;
  if (fresh) held.law = {};
  Vec3 slide = fresh ? Vec3(-displacement) : Vec3(now.g - held.g);
  slide -= slide.dot(contact.nhat) * contact.nhat;
  held.fresh = false;
  held.g = now.g;
  return friction.law.hold({friction.period, fresh, slipped, friction.mu_static, friction.mu_dynamic,
                            friction.stiffness, contact.depth, contact.nhat, displacement, slide, friction.q_BA},
                           held.law);
}

bool meets(const Vec3& a, const Vec3& b, double r) noexcept {
  constexpr double kSame = 1e-4;  // relative to r: accuracy of two motions to the same point
  return (a - b).norm() <= kSame * r;
}

/// No contact: the fingertip follows the frictionless point, if a path leads there.
bool letGo(const Vec3& from, const Friction& friction, const Holding& now, Held& held,
           FrictionAnswer& answer) noexcept {
  ProxyContact& contact = now.contact;
  const ProxyMove back = now.move(from, contact.state.god_object);
  if (!meets(back.x, contact.state.god_object, now.r)) startAgainFrom(back.x, now, held);
  contact.x = contact.state.x;
  if (!contact.state.touching) return true;
  // a contact that begins here: nothing is stretched yet, but the dynamics needs the law's bounds
  answer = ask(friction, now, true, false, held, Vec3::Zero());
  return keepsContract(answer, contact.depth);
}

/// Moves the goal sideways to where the law allows it, and the proxy there; also when the body that friction held on to
/// is gone.
void follow(const Vec3& from, const Vec3& stretch, const Holding& now, Held& held) noexcept {
  ProxyState& state = now.contact.state;
  held.stick_anchor = now.g + stretch;
  const ProxyMove moved = now.move(from, held.stick_anchor);
  state.x = moved.x;
  const Vec3 normal = moved.x - held.stick_anchor;
  if (!moved.touching) {
    // no surface on the path, hence no normal force and no friction
    state.slipping = true;
    held.stick_anchor = state.god_object;
    const ProxyMove back = now.move(moved.x, state.god_object);
    state.x = state.god_object;
    if (!meets(back.x, state.god_object, now.r)) startAgainFrom(back.x, now, held);
  } else if (normal.dot(now.contact.nhat) < kSameSide * normal.norm()) {
    startAgainFrom(moved.x, now, held);
  }
}

}  // namespace

bool holdByFriction(ProxyContact& contact, const ProxyState& last, Held& held, const Vec3& g, double r,
                    const Friction& friction, const ProxyMover& mover, Surroundings& near,
                    FrictionAnswer& answer) noexcept {
  if (!contact.state.touching && !last.touching) return true;
  const Holding now{contact, g, r, mover, near};
  near.use(Point::kHeld);
  if (!contact.state.touching) return letGo(last.x, friction, now, held, answer);
  const Vec3 from = last.touching ? last.x : contact.first_touch;
  if (!last.touching) held.stick_anchor = contact.first_touch;
  Vec3 displacement = held.stick_anchor - contact.state.god_object;
  displacement -= displacement.dot(contact.nhat) * contact.nhat;
  const bool fresh = !last.touching || held.fresh;
  answer = ask(friction, now, fresh, last.touching && last.slipping, held, displacement);
  if (!keepsContract(answer, contact.depth)) return false;
  contact.state.slipping = answer.slipping;

  // a sticking proxy stays fixed in the body's coordinates, so there is no drift to correct
  if (!contact.state.slipping && answer.stretch == displacement && mover.isSupported(from, r, near)) {
    contact.state.x = from;
  } else {
    follow(from, answer.stretch, now, held);
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
  LawStage(const SurfacesInForce& surfaces, const ProxyMover& mover)
      : surfaces_(surfaces), laws_(surfaces.scene), mover_(mover), held_(surfaces.scene.devices.size()) {}

  void changeFrame(std::size_t finger, const Pose& X_BA) noexcept override {
    Held& held = held_[finger];
    held.stick_anchor = X_BA * held.stick_anchor;
    held.g = X_BA * held.g;
    held.law.vector = X_BA.q * held.law.vector;
  }

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
    if (!holdByFriction(tick.contact, tick.finger.tip, held_[tick.index], tick.g, tick.r, friction, mover_,
                        *tick.finger.near, answer)) {
      int none = -1;
      broken_.compare_exchange_strong(none, body, std::memory_order_acq_rel);
    }
    tick.broken = tick.broken || broken_.load(std::memory_order_relaxed) >= 0;
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
  const ProxyMover& mover_;
  std::vector<Held> held_;       // by finger
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
  ChangingFriction(const SurfacesInForce& surfaces, const ProxyMover& mover, const In<SurfaceChange>& change)
      : LawStage(surfaces, mover), change_(change) {
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

std::unique_ptr<FrictionStage> makeFriction(const SurfacesInForce& surfaces, const ProxyMover& mover) {
  return std::make_unique<SteadyFriction>(surfaces, mover);
}
std::unique_ptr<FrictionStage> makeChangingFriction(const SurfacesInForce& surfaces, const ProxyMover& mover,
                                                    const In<SurfaceChange>& change) {
  return std::make_unique<ChangingFriction>(surfaces, mover, change);
}

}  // namespace presa
