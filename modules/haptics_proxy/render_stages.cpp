#include <algorithm>

#include "modules/haptics_proxy/contact_set.h"

namespace presa {
namespace {

constexpr double kNear = 1.06;  // a body within this times r of a free fingertip's centre carries the proxy

/// Converts the result into contact state and spring force, and stores the finger's state for the next tick.
class Spring : public FingerStage {
 public:
  explicit Spring(const SurfacesInForce& surfaces) : surfaces_(surfaces) {}
  void apply(FingerTick& tick) noexcept override;
  std::string what() const override { return "spring between proxy and HIP"; }

 private:
  static std::int32_t nearestBody(const FingerTick& tick) noexcept;
  static void countWhatWentWrong(FingerTick& tick) noexcept;
  static bool leaps(const FingerTick& tick) noexcept;

  const SurfacesInForce surfaces_;
};

void Spring::apply(FingerTick& tick) noexcept {
  ProxyContact& contact = tick.contact;
  RenderedFinger& finger = tick.finger;
  FingerContact& out = tick.out;
  countWhatWentWrong(tick);
  if (leaps(tick)) ++tick.all.leaps_by_finger[tick.index];
  const bool touching = contact.state.touching;
  if (touching) {
    contact.x -= finger.lift * contact.nhat;
    contact.depth -= finger.lift;
    divideContact(tick);
  }
  finger.tip = contact.state;
  out.p_WP = tick.X_WA * contact.x;
  tick.next_frame = touching ? contact.body : nearestBody(tick);
  if (tick.next_frame != finger.frame) {
    tick.X_BA = tick.touchables.frameOf(tick.next_frame).inverse() * tick.touchables.frameOf(finger.frame);
    contact.x = tick.X_BA * contact.x;
  }
  if (!touching) {
    out.p_BP = out.p_WP;
    return;
  }
  const double radius = tick.r - finger.lift;
  const Material& material = surfaces_.of(contact.body);
  out.mode = contact.state.slipping ? ContactMode::kSlip : ContactMode::kStick;
  out.body = contact.body;
  out.nhat_W = tick.X_WA.q * contact.nhat;
  out.nhat_B = tick.touchables.frameOf(contact.body).q.conjugate() * out.nhat_W;
  out.p_BP = contact.x;
  out.p_BC = out.p_BP - radius * out.nhat_B;
  out.depth = contact.depth;
  out.stiffness = material.stiffness;
  out.normal_force = std::max(0.0, material.stiffness * contact.depth);
  out.tangential_force_W = material.stiffness * (tick.X_WA.q * contact.tangential_displacement);
}

// The body next to a free fingertip, or about to be: in its coordinates the proxy sees the surface approach.
std::int32_t Spring::nearestBody(const FingerTick& tick) noexcept {
  constexpr double kTicksAhead = 2;
  constexpr double kFast =
      0.25;  // relative to r per tick: a slower body that overlaps is still on the side from which it came
  Surroundings& near = *tick.finger.near;
  near.use(Point::kGodObject);
  std::int32_t body = kNoBody;
  double min = tick.approach > kFast * tick.r ? tick.r + kTicksAhead * tick.approach : kNear * tick.r;
  near.focus(tick.contact.state.x, min);
  near.forEachWithin(tick.contact.state.x, min, [&](const NearPiece& piece) {
    if (piece.at.distance >= min) return;
    min = piece.at.distance;
    body = piece.body;
  });
  return body;
}

// Tests the result against the surfaces, independently of the algorithm.
void Spring::countWhatWentWrong(FingerTick& tick) noexcept {
  Surroundings& near = *tick.finger.near;
  if (near.crowded()) ++tick.all.coverage_lost;
  const bool crossed = tick.contact.swept ? near.passedThrough(tick.contact.state.x, tick.r) : tick.contact.crossed;
  if (!crossed) return;
  ++tick.all.pop_through;
  ++tick.all.pop_through_by_finger[tick.index];
}

// A leap: the frictionless point normally follows the HIP closely; it moves much farther when the surface that held it
// ends.
bool Spring::leaps(const FingerTick& tick) noexcept {
  constexpr double kOfStep = 8;     // minimum length of a leap relative to the motion of HIP and bodies
  constexpr double kOfDepth = 0.1;  // minimum length relative to the depth; shorter ones are imperceptible
  const ProxyState &last = tick.finger.tip, &now = tick.contact.state;
  if (!last.touching || !now.touching || !tick.contact.swept) return false;
  const double way = (now.god_object - last.god_object).norm();
  return way > kOfStep * tick.finger.near->step() && way > kOfDepth * (last.god_object - tick.g).norm();
}

class SoftSpring final : public Spring {
 public:
  using Spring::Spring;
  void apply(FingerTick& tick) noexcept override {
    Spring::apply(tick);
    tick.out.stiffness *= tick.softness;
    tick.out.normal_force *= tick.softness;
    tick.out.tangential_force_W *= tick.softness;
  }
};

class Damping final : public FingerStage {
 public:
  explicit Damping(const SurfacesInForce& surfaces) : surfaces_(surfaces) {}
  void apply(FingerTick& tick) noexcept override {
    FingerContact& out = tick.out;
    if (out.body == kNoBody) return;
    const double damping = surfaces_.of(out.body).damping;
    const Vec3 relative = out.v_WH - tick.touchables.velocityAt(out.body, out.p_WP - tick.r * out.nhat_W);
    out.damping = damping;
    out.normal_force = std::max(0.0, out.stiffness * out.depth - damping * relative.dot(out.nhat_W));
  }
  std::string what() const override { return "surface damping along the normal"; }

 private:
  const SurfacesInForce surfaces_;
};

class Impulse final : public FingerStage {
 public:
  explicit Impulse(std::size_t fingers) : sums_(fingers, Vec3::Zero()) {}
  void apply(FingerTick& tick) noexcept override {
    FingerContact& out = tick.out;
    sums_[tick.index] += tick.period * (out.normal_force * out.nhat_W + out.tangential_force_W);
    out.impulse_H_W = sums_[tick.index];
  }
  std::string what() const override { return "sum the impulse on each finger, for the averaged coupling"; }

 private:
  std::vector<Vec3> sums_;  // by finger [N s]
};

}  // namespace

std::unique_ptr<FingerStage> makeImpulse(std::size_t fingers) { return std::make_unique<Impulse>(fingers); }
std::unique_ptr<FingerStage> makeSpring(const SurfacesInForce& surfaces) { return std::make_unique<Spring>(surfaces); }
std::unique_ptr<FingerStage> makeSoftSpring(const SurfacesInForce& surfaces) {
  return std::make_unique<SoftSpring>(surfaces);
}
std::unique_ptr<FingerStage> makeDamping(const SurfacesInForce& surfaces) {
  return std::make_unique<Damping>(surfaces);
}

}  // namespace presa
