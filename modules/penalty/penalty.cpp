#include <cmath>
#include <vector>

#include "framework/haptics/renderer.h"

namespace presa {
namespace {

/// The point of one body's surface nearest to the HIP.
struct NearestSurface {
  std::int32_t body = kNoBody;
  double distance = 0;         ///< >= 0 [m]
  double signed_distance = 0;  ///< negative inside the body [m]
  Vec3 nhat = Vec3::UnitZ();   ///< unit outward normal
  double facing = 0;           ///< cosine to the HIP: decides between triangles that share the point
};

constexpr double kTie = 1e-9;  // relative difference below which two triangles share their nearest point

NearestSurface surfaceOf(const NearPiece& piece, const Surroundings::Triangle& triangle, const Mat3& R_AG) noexcept {
  const Nearest& at = piece.at;
  if (triangle.facet == nullptr) return {piece.body, std::abs(at.distance), at.distance, at.nhat, 1};
  const auto corner = [&](std::size_t i) -> const Vec3& { return triangle.tree->corner(*triangle.facet, i); };
  const Vec3 outward = R_AG * (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
  const double facing = at.nhat.dot(outward);
  const double side = facing < 0 ? -1.0 : 1.0;
  return {piece.body, at.distance, side * at.distance, side * at.nhat, std::abs(facing)};
}

/// Penalty method, the baseline without a proxy: the force is proportional to the depth below the *nearest* surface,
/// and nothing is remembered. Beyond the middle of a thin part the nearest surface is the far one, and the finger is
/// pushed out there. With `sum` the forces of all bodies add up, as in the textbooks; otherwise the deepest one acts.
class Penalty final : public Renderer {
 public:
  Penalty(std::size_t tools, bool sum) : sum_(sum), last_(tools) {}

  ProxyContact touch(const RenderInput& input) noexcept override {
    ProxyContact contact;
    contact.swept = false;
    NearestSurface deepest;
    deepest.signed_distance = input.radius;
    Vec3 push = Vec3::Zero();
    Last& last = last_[input.tool];
    // a surface that is farther away can neither be touched nor have been crossed in this tick
    const double reach = 2 * input.radius + last.depth + input.near.step();
    forEachBody(input.g, input.radius, reach, input.near, [&](const NearestSurface& surface) {
      const double depth = input.radius - surface.signed_distance;
      if (sum_ && input.contacts.add({surface.body, surface.nhat, depth}) != nullptr) push += depth * surface.nhat;
      if (surface.signed_distance < deepest.signed_distance) deepest = surface;
    });
    if (!sum_) push = (input.radius - deepest.signed_distance) * deepest.nhat;
    contact.x = contact.state.x = contact.state.god_object = input.g + push;
    if (deepest.body == kNoBody) {
      last = {};
      return contact;
    }
    contact.state.touching = contact.state.slipping = true;
    contact.body = deepest.body;
    contact.depth = push.norm();
    contact.nhat = contact.depth > 0 ? Vec3(push / contact.depth) : deepest.nhat;
    // a force that reverses from one tick to the next: the finger went through, as this method lets it
    const Vec3 nhat_W = input.X_WA.q * contact.nhat;
    contact.crossed = nhat_W.dot(last.nhat_W) < 0;
    last = {nhat_W, input.radius - deepest.signed_distance};
    return contact;
  }
  std::size_t maxOwnContacts() const noexcept override { return sum_ ? kMaxBodies : 0; }
  std::string what() const override {
    return sum_ ? "push out of every body (penalty, forces added up, no memory)"
                : "push towards the nearest surface (penalty, no memory)";
  }

 private:
  static constexpr std::size_t kMaxBodies = 16;

  /// Contact of the last tick.
  struct Last {
    Vec3 nhat_W = Vec3::Zero();
    double depth = 0;  ///< [m]
  };

  /// Calls use(NearestSurface) for each body that the tool overlaps and whose surface is within `reach`.
  template <class Use>
  static void forEachBody(const Vec3& g, double r, double reach, Surroundings& near, const Use& use) noexcept {
    near.focus(g, reach);
    for (int source = -1; source < near.meshCount(); ++source) {
      // a mesh contributes its nearest surface only; each primitive is a body of its own
      NearestSurface nearest;
      double limit = reach;
      near.forEachWithin(source, g, limit, [&](const NearPiece& piece) {
        const NearestSurface found = surfaceOf(piece, near.triangleOf(piece.ref, g), near.turnOf(piece.ref));
        if (source < 0) {
          if (found.signed_distance < r) use(found);
          return;
        }
        const bool first = nearest.body == kNoBody;
        const bool shared = !first && found.distance < nearest.distance * (1 + kTie) && found.facing > nearest.facing;
        if (first || shared || found.distance < nearest.distance * (1 - kTie)) nearest = found;
        limit = nearest.distance * (1 + kTie);
      });
      if (nearest.body != kNoBody && nearest.signed_distance < r) use(nearest);
    }
  }

  bool sum_;
  std::vector<Last> last_;  // by tool
};

const RendererPlugin kPlugin{
    .name = "penalty", .create = [](const PluginElement& settings, const World& world) -> std::unique_ptr<Renderer> {
      return std::make_unique<Penalty>(world.scene.devices.size(), settings.boolean("sum"));
    }};

}  // namespace
}  // namespace presa

PRESA_RENDERER_PLUGIN(presa::kPlugin)
