#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "framework/haptics/renderer.h"

namespace presa {
namespace {

/// Stands for a surface near the point q: a sphere of the given curvature, or a plane (0). Working frame A.
struct Local {
  std::int32_t body = kNoBody;
  Vec3 q = Vec3::Zero();      ///< on the surface
  Vec3 nhat = Vec3::UnitZ();  ///< outward
  double curvature = 0;       ///< > 0: convex [1/m]
  bool inside = false;        ///< the point it was sought from lies inside the body

  /// Where the tool of radius r touches it next to g; g itself when it does not touch.
  Vec3 proxyAt(const Vec3& g, double r) const noexcept {
    if (body == kNoBody) return g;
    if (curvature == 0) return g + std::max(0.0, r - nhat.dot(g - q)) * nhat;
    const Vec3 center = q - nhat / curvature, away = g - center;
    const double distance = away.norm(), held = std::abs(1 / curvature + r);
    const double depth = curvature > 0 ? held - distance : distance - held;
    return depth > 0 && distance > 0 ? Vec3(g + std::copysign(depth / distance, curvature) * away) : g;
  }
};

/// One tool: what it feels now, what it felt before the last hand-over.
struct Tool {
  Local now, before;
  int since = std::numeric_limits<int>::max();  ///< ticks since the last hand-over
};

class Intermediate final : public Renderer {
 public:
  Intermediate(std::size_t tools, const PluginElement& settings)
      : sphere_(settings.boolean("sphere")),
        every_(static_cast<int>(settings.number("every"))),
        blend_(static_cast<int>(settings.number("blend"))),
        tools_(tools) {}

  ProxyContact touch(const RenderInput& input) noexcept override {
    Tool& tool = tools_[input.tool];
    ProxyContact contact;
    contact.swept = false;
    if (tool.since >= every_) {
      handOver(input, tool);
      contact.crossed = tool.now.inside;
    }
    Vec3 x = tool.now.proxyAt(input.g, input.radius);
    if (tool.since < blend_) {
      const double old = 1 - (tool.since + 1.0) / (blend_ + 1.0);
      x += old * (tool.before.proxyAt(input.g, input.radius) - x);  // exactly 0 away from both
    }
    ++tool.since;
    contact.x = contact.state.x = contact.state.god_object = x;
    const Vec3 push = x - input.g;
    contact.depth = push.norm();
    if (!(contact.depth > 0)) return contact;
    contact.state.touching = contact.state.slipping = true;
    contact.body = tool.now.body != kNoBody ? tool.now.body : tool.before.body;
    contact.nhat = push / contact.depth;
    return contact;
  }
  void changeFrame(std::size_t tool, const Pose& X_BA) noexcept override {
    for (Local* local : {&tools_[tool].now, &tools_[tool].before}) {
      local->q = X_BA * local->q;
      local->nhat = X_BA.q * local->nhat;
    }
  }
  std::string what() const override {
    return std::string("push out of a ") + (sphere_ ? "sphere" : "plane") + " that stands for the surface, new every " +
           std::to_string(every_) + " ticks";
  }

 private:
  void handOver(const RenderInput& input, Tool& tool) const noexcept {
    constexpr double kMargin = 1e-3;  // on top of the radius: what the last plane may be off [m]
    const Vec3 x = tool.now.proxyAt(input.g, input.radius);
    const Local found = nearest(x, input.radius + kMargin, input.near);
    tool.before = tool.now;
    tool.now = found;
    tool.since = 0;
    if (!sphere_) return;
    const double curvature = curvatureAlong(tool.before, found);
    if (curvature * input.radius > -kHollow) tool.now.curvature = curvature;
  }

  static constexpr double kHollow = 0.9;  // a narrower hollow does not admit the tool

  /// Curvature of the path from one point of a surface to another.
  static double curvatureAlong(const Local& from, const Local& to) noexcept {
    constexpr double kShort = 1e-5;   // too short a way says nothing [m]
    constexpr double kMaxTurn = 0.5;  // a sharper turn is an edge [rad]
    const Vec3 way = to.q - from.q, turn = to.nhat - from.nhat;
    if (from.body != to.body || !(way.norm() > kShort)) return from.body == to.body ? from.curvature : 0;
    return turn.norm() > kMaxTurn ? 0 : turn.dot(way) / way.squaredNorm();
  }

  /// The surface nearest to x. Searches a small ball first, because far more of a mesh lies in a large one.
  static Local nearest(const Vec3& x, double near_by, Surroundings& near) noexcept {
    constexpr double kFar = 0.1;  // [m]
    for (double radius = near_by; radius < kFar; radius *= 4) {
      const Local found = nearestWithin(x, radius, near);
      if (found.body != kNoBody) return found;
    }
    return nearestWithin(x, std::numeric_limits<double>::infinity(), near);
  }
  static Local nearestWithin(const Vec3& x, double limit, Surroundings& near) noexcept {
    Local found;
    near.focus(x, limit);
    near.forEachWithin(x, limit, [&](const NearPiece& piece) {
      if (piece.at.distance > limit) return;
      limit = piece.at.distance;
      found.body = piece.body;
      found.q = x - piece.at.distance * piece.at.nhat;
      found.inside = isInside(piece, near, x);
      found.nhat = found.inside && piece.at.distance > 0 ? Vec3(-piece.at.nhat) : piece.at.nhat;
    });
    return found;
  }
  static bool isInside(const NearPiece& piece, Surroundings& near, const Vec3& x) noexcept {
    const Surroundings::Triangle triangle = near.triangleOf(piece.ref, x);
    if (triangle.facet == nullptr) return piece.at.distance < 0;
    const auto corner = [&](std::size_t i) -> const Vec3& { return triangle.tree->corner(*triangle.facet, i); };
    const Vec3 outward = near.turnOf(piece.ref) * (corner(1) - corner(0)).cross(corner(2) - corner(0));
    return piece.at.nhat.dot(outward) < 0;
  }

  bool sphere_;
  int every_, blend_;
  std::vector<Tool> tools_;
};

const RendererPlugin kPlugin{
    .name = "intermediate",
    .create = [](const PluginElement& settings, const World& world) -> std::unique_ptr<Renderer> {
      return std::make_unique<Intermediate>(world.scene.devices.size(), settings);
    }};

}  // namespace
}  // namespace presa

PRESA_RENDERER_PLUGIN(presa::kPlugin)
