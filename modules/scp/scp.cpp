#include "framework/haptics/nearest_feasible.h"
#include "framework/haptics/renderer.h"

namespace presa {
namespace {

constexpr double kGap = 1e-10, kTouch = 1e-9;  // relative to the radius: gap at which a motion stops, gap of a contact

/// Constraint polygons C, and the surface point that they allow.
class Constraints {
 public:
  Constraints(double r, Surroundings& near) : r_(r), near_(near) { near.clearMarks(); }

  /// Adds every polygon that a tool at x touches.
  void addAt(const Vec3& x) noexcept {
    near_.forEachWithin(x, r_ * (1 + kTouch), [&](const NearPiece& piece) {
      walls_.add({piece.at.nhat, piece.at.nhat.dot(x) + r_ - piece.at.distance, piece.body}, x);
      near_.mark(piece.ref);
    });
  }
  /// Part of the way from x to y until another polygon, 1 if there is none.
  double freePart(const Vec3& x, const Vec3& y) noexcept {
    return near_.firstTouch(x, y - x, 1, r_, {kGap * r_, kTouch * r_});
  }
  Feasible nearestTo(const Vec3& g) noexcept { return nearestFeasible(walls_, g); }
  std::int32_t bodyOf(const Feasible& point) const noexcept {
    return point.active_count > 0 ? walls_.item[static_cast<std::size_t>(point.active[0])].tag : kNoBody;
  }

 private:
  HalfSpaces walls_;
  double r_;
  Surroundings& near_;
};

class Scp final : public Renderer, public ProxyMover {
 public:
  explicit Scp(bool older) : older_(older) {}

  ProxyContact touch(const RenderInput& in) noexcept override {
    in.near.use(Point::kGodObject);
    return contactOf(move(in.last.god_object, in.g, in.radius, in.near), in.g);
  }
  const ProxyMover* mover() const noexcept override { return this; }

  ProxyMove move(const Vec3& x, const Vec3& g, double r, Surroundings& near) const noexcept override {
    near.focus(x, r + 2 * (g - x).norm());
    Constraints constraints(r, near);
    ProxyMove moved;
    moved.first_touch = x;
    const Feasible point = older_ ? olderForm(x, g, constraints) : newerForm(x, g, constraints);
    moved.x = point.y;
    moved.touching = point.active_count > 0;
    moved.body = constraints.bodyOf(point);
    if (!moved.touching) moved.first_touch = moved.x;
    near.leaveTrail(moved.x);
    return moved;
  }
  bool isSupported(const Vec3& x, double r, Surroundings& near) const noexcept override {
    bool touches = false, overlaps = false;
    near.focus(x, r * (1 + kTouch));
    near.forEachWithin(x, r * (1 + kTouch), [&](const NearPiece& piece) {
      touches = true;
      overlaps = overlaps || piece.at.distance < r * (1 - kTouch);
    });
    return touches && !overlaps;
  }
  std::string what() const override {
    return older_ ? "move the surface contact point under three polygons (scp, older form)"
                  : "move the surface contact point under the polygons that it meets (scp)";
  }

 private:
  static Feasible newerForm(const Vec3& x, const Vec3& g, Constraints& constraints) noexcept {
    constexpr int kRounds = 16;  // the print has no bound
    constraints.addAt(x);
    for (int round = 1;; ++round) {
      Feasible point = constraints.nearestTo(g);
      const double free = constraints.freePart(x, point.y);
      if (free >= 1) return point;
      const Vec3 met = x + free * (point.y - x);
      if (round == kRounds) {
        point.y = met;
        return point;
      }
      constraints.addAt(met);
    }
  }
  static Feasible olderForm(const Vec3& x, const Vec3& g, Constraints& constraints) noexcept {
    constexpr int kPolygons = 3;
    for (int round = 0; round < kPolygons; ++round) {
      const double free = constraints.freePart(x, g);
      if (free >= 1) break;
      constraints.addAt(x + free * (g - x));
    }
    return constraints.nearestTo(g);
  }

  bool older_;
};

const RendererPlugin kPlugin{.name = "scp",
                             .create = [](const PluginElement& settings, const World&) -> std::unique_ptr<Renderer> {
                               return std::make_unique<Scp>(settings.boolean("older"));
                             }};

}  // namespace
}  // namespace presa

PRESA_RENDERER_PLUGIN(presa::kPlugin)
