// Friction on the god-object (PERCRO paper, section 3.3). The laws (framework/haptics/friction_law.h) say how far the
// proxy may lag behind the frictionless point; this file moves the proxy there. A sticking proxy is not moved at all. The
// tangential displacement is stored at the HIP (anchor), not recomputed from the proxy, which would drift on curved
// surfaces. Several bodies that hold a finger are springs in parallel: each has its own anchor and its share of the
// stiffness, its share of the force is bounded by its own normal force, and the proxy is the mean of all.
// Invariants: a touching proxy lies on a surface, and every motion of it is swept (ProxyMover).
#include "modules/haptics_proxy/friction.h"

#include <algorithm>

namespace presa {
namespace {

/// One finger in one tick.
struct Holding {
  ProxyContact& contact;
  std::span<const RenderedContact> own;
  const Vec3& g;
  double r;
  const Friction& friction;
  const ProxyMover& mover;
  Surroundings& near;
  Held& held;

  ProxyMove move(const Vec3& from, const Vec3& to) const noexcept { return mover.move(from, to, r, near); }
};

/// Calls `use(body, depth * nhat)` for each constraint that holds the finger.
template <class Use>
void forEachConstraint(const Holding& now, const Use& use) noexcept {
  const ActiveSet& active = now.contact.active;
  for (const RenderedContact& one : now.own) use(one.body, one.depth * one.nhat);
  if (!now.own.empty()) return;
  for (int a = 0; a < active.count; ++a) {
    const ActiveSet::Member& member = active.member[static_cast<std::size_t>(a)];
    if (member.weight > 0) use(member.body, member.weight * member.nhat);
  }
}

BodyFriction begin(std::int32_t body, const Held& held, bool slipping) noexcept {
  return {.body = body, .anchor = held.anchor, .slipping = slipping};
}

void holdBy(std::int32_t only, Held& held, double depth, bool slipping) noexcept {
  if (held.bodies.size() != 1 || held.bodies[0].body != only) {
    BodyFriction* const known = std::ranges::find(held.bodies, only, &BodyFriction::body);
    const BodyFriction kept = known != held.bodies.end() ? *known : begin(only, held, slipping);
    held.bodies.clear();
    held.bodies.add(kept);
  }
  held.bodies[0].depth = held.depth = depth;
  held.bodies[0].share = 1;
}

/// Lists the bodies that hold the finger. A new one holds it where the others do, and slips if the finger does.
void gather(const Holding& now, bool slipping) noexcept {
  Held& held = now.held;
  const std::int32_t main = now.contact.body;
  bool alone = true;
  forEachConstraint(now, [&](std::int32_t body, const Vec3&) { alone = alone && body == main; });
  if (alone) return holdBy(main, held, now.contact.depth, slipping);
  const auto depthOf = [&](std::int32_t body) {
    Vec3 sum = Vec3::Zero();
    forEachConstraint(now, [&](std::int32_t other, const Vec3& part) {
      if (other == body) sum += part;
    });
    return sum.norm();
  };
  for (std::size_t i = held.bodies.size(); i-- > 0;) {
    if (!(depthOf(held.bodies[i].body) > 0)) held.bodies.remove(i);
  }
  forEachConstraint(now, [&](std::int32_t body, const Vec3&) {
    if (std::ranges::find(held.bodies, body, &BodyFriction::body) == held.bodies.end())
      held.bodies.add(begin(body, held, slipping));
  });
  held.depth = 0;
  for (BodyFriction& one : held.bodies) held.depth += one.depth = depthOf(one.body);
  for (BodyFriction& one : held.bodies) one.share = one.depth / held.depth;
}

/// Restarts both points from the fingertip at `x`, without friction. Needed where the frictionless point took another
/// path, round an edge or out of a fold that the fingertip is still in.
void startAgainFrom(const Vec3& x, const Holding& now) noexcept {
  const ProxyMove free = now.move(x, now.g);
  ProxyContact& contact = now.contact;
  contact.state.x = contact.state.god_object = now.held.anchor = free.x;
  contact.state.touching = contact.state.slipping = free.touching;
  now.held.fresh = true;
  contact.depth = free.touching ? (free.x - now.g).norm() : 0;
  contact.body = free.body;
  contact.first_touch = free.first_touch;
  contact.active = free.active;
  if (contact.depth > 0) contact.nhat = (free.x - now.g) / contact.depth;
}

constexpr double kSameSide = 0.5;  // minimum cosine between normals on the same side of a body

/// Motion of the finger over the bodies since the last tick; between several only along the planes of all.
Vec3 slideOf(const Holding& now) noexcept {
  const Vec3 motion = now.g - now.held.g;
  const Vec3& nhat = now.contact.nhat;
  if (now.held.bodies.size() == 1) return motion - motion.dot(nhat) * nhat;
  Mat3 along = Mat3::Identity();
  forEachConstraint(now, [&](std::int32_t, const Vec3& part) { keepAlong(part.normalized(), along); });
  return along * motion;
}

/// Asks the law of every body that holds the finger. Returns the body whose law broke its contract, or kNoBody.
std::int32_t ask(const Holding& now, bool fresh) noexcept {
  const ProxyContact& contact = now.contact;
  Held& held = now.held;
  const Vec3 slide = slideOf(now);
  std::int32_t broken = kNoBody;
  for (BodyFriction& one : held.bodies) {
    const BodyLaw with = now.friction.of(one.body);
    // a body with a share of the stiffness and the same share of the normal force: as if it held the finger alone
    const double depth = held.depth;
    one.answer = with.law->hold(
        {now.friction.period(), one.fresh, one.slipping, with.mu_static, with.mu_dynamic, now.friction.stiffness(),
         depth, contact.nhat, one.displacement, fresh ? Vec3(-one.displacement) : slide, with.q_BA},
        one.law);
    if (!keepsContract(one.answer, depth)) broken = one.body;
    one.fresh = false;
    one.slipping = one.answer.slipping;
  }
  held.fresh = false;
  held.g = now.g;
  return broken;
}

/// A contact that begins without a motion: nothing is stretched yet, but the dynamics needs the bounds of the laws.
std::int32_t beginAnew(const Holding& now) noexcept {
  now.held.bodies.clear();
  gather(now, false);
  return ask(now, true);
}

bool meets(const Vec3& a, const Vec3& b, double r) noexcept {
  constexpr double kSame = 1e-4;  // relative to r: accuracy of two motions to the same point
  return (a - b).norm() <= kSame * r;
}

/// No contact: the fingertip follows the frictionless point, if a path leads there.
std::int32_t letGo(const Vec3& from, const Holding& now) noexcept {
  ProxyContact& contact = now.contact;
  const ProxyMove back = now.move(from, contact.state.god_object);
  if (!meets(back.x, contact.state.god_object, now.r)) startAgainFrom(back.x, now);
  contact.x = contact.state.x;
  return contact.state.touching ? beginAnew(now) : kNoBody;
}

/// Moves the goal sideways to where the laws allow it, and the proxy there; also when a body that friction held on to
/// is gone.
void follow(const Vec3& from, const Vec3& stretch, const Holding& now) noexcept {
  ProxyState& state = now.contact.state;
  Held& held = now.held;
  held.anchor = now.g + stretch;
  for (BodyFriction& one : held.bodies) one.anchor = now.g + one.answer.stretch;
  const ProxyMove moved = now.move(from, held.anchor);
  state.x = moved.x;
  const Vec3 normal = moved.x - held.anchor;
  if (!moved.touching) {
    // no surface on the path, hence no normal force and no friction
    held.anchor = state.god_object;
    state.slipping = true;
    for (BodyFriction& one : held.bodies) {
      one.anchor = held.anchor;
      one.slipping = true;
    }
    const ProxyMove back = now.move(moved.x, state.god_object);
    state.x = state.god_object;
    if (!meets(back.x, state.god_object, now.r)) startAgainFrom(back.x, now);
  } else if (normal.dot(now.contact.nhat) < kSameSide * normal.norm()) {
    startAgainFrom(moved.x, now);
  }
}

constexpr double kSamePlane = 0.99;  // cosine of 8 degrees; below, friction errs by 3 %

/// The frictionless point may be round an edge while friction still holds the proxy before it. Then the law acts in the
/// plane under the proxy: there the finger rubs. Returns whether the contact is changed so; never one with several
/// bodies.
bool isBeforeAnEdge(const Vec3& from, const Holding& now) noexcept {
  ProxyContact& contact = now.contact;
  const Held& held = now.held;
  if (held.bodies.size() != 1) return false;
  bool alone = held.bodies[0].body == contact.body;
  forEachConstraint(now, [&](std::int32_t body, const Vec3&) { alone = alone && body == contact.body; });
  if (!alone || !now.own.empty()) return false;
  const Vec3 normal = from - held.anchor;
  const double length = normal.norm(), depth = (from - now.g).dot(normal);
  if (!(depth > 0) || normal.dot(contact.nhat) >= kSamePlane * length) return false;
  contact.nhat = normal / length;
  contact.depth = depth / length;
  contact.active = {};
  return true;
}

/// Whether every body lets its anchor be where it is, and all anchors are one point of the surface.
bool allStick(const Held& held) noexcept {
  return std::ranges::all_of(held.bodies, [&](const BodyFriction& one) {
    return !one.slipping && one.answer.stretch == one.displacement && one.anchor == held.bodies[0].anchor;
  });
}

}  // namespace

std::int32_t holdByFriction(ProxyContact& contact, std::span<const RenderedContact> own, const ProxyState& last,
                            Held& held, const Vec3& g, double r, const Friction& friction, const ProxyMover& mover,
                            Surroundings& near) noexcept {
  if (!contact.state.touching && !last.touching) return kNoBody;
  const Holding now{contact, own, g, r, friction, mover, near, held};
  near.use(Point::kHeld);
  if (!contact.state.touching) return letGo(last.x, now);
  const Vec3 from = last.touching ? last.x : contact.first_touch;
  if (!last.touching) held.anchor = contact.first_touch;
  const bool fresh = !last.touching || held.fresh;
  if (fresh) held.bodies.clear();
  const Vec3& frictionless = isBeforeAnEdge(from, now) ? g : contact.state.god_object;
  gather(now, last.touching && last.slipping);
  for (BodyFriction& one : held.bodies) {
    one.displacement = one.anchor - frictionless;
    one.displacement -= one.displacement.dot(contact.nhat) * contact.nhat;
  }
  const std::int32_t broken = ask(now, fresh);
  if (broken != kNoBody) return broken;
  Vec3 stretch = Vec3::Zero();
  contact.state.slipping = true;
  for (const BodyFriction& one : held.bodies) {
    stretch += one.share * one.answer.stretch;
    contact.state.slipping = contact.state.slipping && one.slipping;
  }

  // a sticking proxy stays fixed in the body's coordinates, so there is no drift to correct
  if (allStick(held) && mover.isSupported(from, r, near)) {
    contact.state.x = from;
  } else {
    follow(from, stretch, now);
  }
  contact.x = contact.state.x;
  const Vec3 away = contact.x - g;
  contact.depth = away.dot(contact.nhat);
  contact.tangential_displacement = away - contact.depth * contact.nhat;
  return kNoBody;
}

}  // namespace presa
