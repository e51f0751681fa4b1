#include <algorithm>
#include <limits>

#include "modules/haptics_proxy/finger_stage.h"
#include "modules/haptics_proxy/touchables.h"

namespace presa {
namespace {

constexpr double kNear = 1.06;  // a body nearer to a free fingertip's centre than this times r carries the proxy

class GodObject final : public FingerStage {
 public:
  void apply(FingerTick& tick) noexcept override {
    tick.contact = slideProxy(tick.finger.tip, tick.g, tick.r, *tick.finger.near);
  }
  const char* what() const override {
    return "move the proxy to the nearest reachable point (active set of at most three)";
  }
};

/// What was found becomes contact state and spring force, and the finger's state for the next tick.
class Spring final : public FingerStage {
 public:
  explicit Spring(const SurfacesInForce& surfaces) : surfaces_(surfaces) {}
  void apply(FingerTick& tick) noexcept override;
  const char* what() const override { return "spring between proxy and HIP"; }

 private:
  static std::int32_t nearestBody(const Vec3& p, double r, Surroundings& near) noexcept;
  static void countPopThrough(FingerTick& tick) noexcept;

  const SurfacesInForce surfaces_;
};

void Spring::apply(FingerTick& tick) noexcept {
  ProxyContact& contact = tick.contact;
  Finger& finger = tick.finger;
  FingerContact& out = tick.out;
  countPopThrough(tick);
  if (!contact.covered) ++tick.all.coverage_lost;
  finger.tip = contact.state;
  out.p_WP = tick.X_WA * contact.x;
  const bool touching = contact.state.touching;
  tick.touchables.moveToFrame(finger, contact.x,
                              touching ? contact.body : nearestBody(contact.state.x, tick.r, *finger.near));
  if (!touching) {
    out.p_BP = out.p_WP;
    return;
  }
  const Material& material = surfaces_.of(contact.body);
  out.mode = contact.state.slipping ? ContactMode::kSlip : ContactMode::kStick;
  out.body = contact.body;
  out.nhat_W = tick.X_WA.q * contact.nhat;
  out.nhat_B = tick.touchables.frameOf(contact.body).q.conjugate() * out.nhat_W;
  out.p_BP = contact.x;
  out.p_BC = out.p_BP - tick.r * out.nhat_B;
  out.depth = contact.depth;
  out.stiffness = material.stiffness;
  out.normal_force = std::max(0.0, material.stiffness * contact.depth);
  // a proxy that waits for its patch would drag: then only the normal part is real
  if (contact.covered) out.tangential_force_W = material.stiffness * (tick.X_WA.q * contact.stretch);
}

// The body next to a free fingertip: kept in its coordinates, the proxy sees it come.
std::int32_t Spring::nearestBody(const Vec3& p, double r, Surroundings& near) noexcept {
  near.lookAround(p, kNear * r, r);
  std::int32_t body = kNoBody;
  double least = kNear * r;
  for (int i = 0; i < near.count(); ++i) {
    if (near.atLeast(i, p) > least) continue;
    if (const double distance = near.nearestTo(i, p).distance; distance < least) {
      least = distance;
      body = near.piece(i).body;
    }
  }
  return body;
}

// Checked apart from the algorithm that should prevent it: the fingertip's centre must never come within
// half its radius of a surface.
void Spring::countPopThrough(FingerTick& tick) noexcept {
  Surroundings& near = *tick.finger.near;
  const Vec3& x = tick.contact.state.x;
  near.lookAround(x, 0.5 * tick.r, tick.r);
  bool overlapping = false;
  for (int i = 0; i < near.count() && !overlapping; ++i) {
    overlapping = near.atLeast(i, x) < 0.5 * tick.r && nearest(near.piece(i), x).distance < 0.5 * tick.r;
  }
  if (overlapping && !tick.finger.overlapping) {
    ++tick.all.pop_through;
    ++tick.all.pop_through_by_finger[tick.index];
  }
  tick.finger.overlapping = overlapping;
}

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
  const char* what() const override { return "surface damping along the normal"; }

 private:
  const SurfacesInForce surfaces_;
};

}  // namespace

std::unique_ptr<FingerStage> makeGodObject() { return std::make_unique<GodObject>(); }
std::unique_ptr<FingerStage> makeSpring(const SurfacesInForce& surfaces) { return std::make_unique<Spring>(surfaces); }
std::unique_ptr<FingerStage> makeDamping(const SurfacesInForce& surfaces) {
  return std::make_unique<Damping>(surfaces);
}

}  // namespace presa
