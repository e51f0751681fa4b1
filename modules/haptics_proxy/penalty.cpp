#include <array>
#include <cmath>

#include "modules/haptics_proxy/finger_stage.h"
#include "modules/haptics_proxy/touchables.h"

namespace presa {
namespace {

/// The surface point of one body that is nearest to the HIP.
struct NearestSurface {
  std::int32_t body = kNoBody;
  double distance = 0;         ///< >= 0 [m]
  double signed_distance = 0;  ///< negative inside the body [m]
  Vec3 nhat = Vec3::UnitZ();   ///< outwards
  double facing = 0;  ///< how squarely its triangle faces the HIP: decides between triangles that share the point
};

constexpr double kTie = 1e-9;  // relative difference below which two triangles share their nearest point

NearestSurface surfaceOf(const ConvexPiece& piece, const Nearest& at) noexcept {
  const auto* triangle = std::get_if<PreparedTriangle>(&piece.shape);
  if (triangle == nullptr) return {piece.body, std::abs(at.distance), at.distance, at.nhat, 1};
  const Vec3 outward = triangle->ab.cross(triangle->ac).normalized();
  const double facing = at.nhat.dot(outward);
  const double side = facing < 0 ? -1.0 : 1.0;
  return {piece.body, at.distance, side * at.distance, side * at.nhat, std::abs(facing)};
}

/// The force rises with how deep the fingertip is below the *nearest* surface, and nothing is remembered: past the middle
/// of a thin part the nearest surface is the far one, and the finger is pushed out there. The baseline that shows what a
/// proxy buys.
class Penalty final : public FingerStage {
 public:
  void apply(FingerTick& tick) noexcept override {
    tick.contact.x = tick.contact.state.x = tick.contact.state.god = tick.g;
    const NearestSurface deepest = deepestUnder(tick.g, tick.r, *tick.finger.near);
    if (deepest.body == kNoBody) {
      tick.finger.penalty_nhat.setZero();
      return;
    }
    ProxyContact& contact = tick.contact;
    contact.state.touching = contact.state.slipping = true;
    contact.body = deepest.body;
    contact.nhat = deepest.nhat;
    contact.depth = tick.r - deepest.signed_distance;
    contact.x = contact.state.x = contact.state.god = tick.g + contact.depth * contact.nhat;
    countFlip(tick);
  }
  const char* what() const override { return "push towards the nearest surface (penalty, no memory)"; }

 private:
  static NearestSurface deepestUnder(const Vec3& g, double r, Surroundings& near) noexcept {
    near.lookAround(g, kEverything, kEverything);
    std::array<NearestSurface, Surroundings::kMaxPrimitives + kMaxNearBodies> bodies;
    std::size_t count = 0;
    for (int i = 0; i < near.count(); ++i) {
      const std::int32_t body = near.piece(i).body;
      std::size_t b = 0;
      while (b < count && bodies[b].body != body) ++b;
      if (b < count && near.atLeast(i, g) > bodies[b].distance * (1 + kTie)) continue;
      if (b == bodies.size()) continue;
      const NearestSurface found = surfaceOf(near.piece(i), near.nearestTo(i, g));
      const bool first = b == count;
      if (first) ++count;
      const bool shared = !first && found.distance < bodies[b].distance * (1 + kTie) && found.facing > bodies[b].facing;
      if (first || shared || found.distance < bodies[b].distance * (1 - kTie)) bodies[b] = found;
    }
    NearestSurface deepest;
    deepest.signed_distance = r;
    for (std::size_t b = 0; b < count; ++b) {
      if (bodies[b].signed_distance < deepest.signed_distance) deepest = bodies[b];
    }
    return deepest;
  }

  // Pushed back one tick and onwards the next: the finger went through. Counted here, where it is no fault but the method.
  static void countFlip(FingerTick& tick) noexcept {
    const Vec3 nhat_W = tick.X_WA.q * tick.contact.nhat;
    if (nhat_W.dot(tick.finger.penalty_nhat) < 0) {
      ++tick.all.pop_through;
      ++tick.all.pop_through_by_finger[tick.index];
    }
    tick.finger.penalty_nhat = nhat_W;
  }

  static constexpr double kEverything = 1;  // [m] more than any patch
};

}  // namespace

std::unique_ptr<FingerStage> makePenalty() { return std::make_unique<Penalty>(); }

}  // namespace presa
