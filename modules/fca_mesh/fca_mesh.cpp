#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "framework/geometry/closest_point.h"
#include "framework/haptics/renderer.h"
#include "modules/fca_mesh/mesh_walk.h"

namespace presa {
namespace {

/// A place on a mesh near the tool.
struct Place {
  const fca::WalkMesh* mesh = nullptr;
  std::int32_t body = kNoBody, triangle = -1;
  Pose X_AG;
};

/// One tool: where it touches, or the triangle that it faces; and where friction holds it.
struct Tool {
  Place place;
  bool touching = false;
  const Surroundings* near = nullptr;  ///< the tool's own
  std::int32_t held = -1;              ///< triangle of place.mesh
  Vec3 held_at = Vec3::Zero();         ///< on that triangle, where move() ended
};

/// Distance of x from the place's triangle: what is nearest is no farther.
double distanceOf(const Place& place, const Vec3& x) noexcept {
  const auto& [a, b, c] = place.mesh->face(place.triangle).corners;
  const Vec3 x_G = place.X_AG.inverseTimes(x);
  return (closestOnTriangle(x_G, a, b, c) - x_G).norm();
}

ProxyMove freeAt(const Vec3& g) noexcept {
  ProxyMove moved{};
  moved.x = moved.first_touch = g;
  return moved;
}

/// Walks to the surface point nearest to g; touching when g lies below the surface there.
ProxyMove walkTo(const Vec3& g, Place& place) noexcept {
  const Vec3 g_G = place.X_AG.inverseTimes(g);
  const fca::SurfacePoint at = fca::walk(*place.mesh, place.triangle, g_G);
  place.triangle = at.triangle;
  ProxyMove moved{};
  moved.touching = (g_G - at.q).dot(fca::outwardAt(*place.mesh, at)) < 0;
  moved.body = moved.touching ? place.body : kNoBody;
  moved.x = moved.first_touch = moved.touching ? place.X_AG * at.q : g;
  return moved;
}

class FcaMesh final : public Renderer, public ProxyMover {
 public:
  explicit FcaMesh(const World& world) : meshes_(world.scene.bodies.size()), tools_(world.scene.devices.size()) {
    for (std::size_t b = 0; b < world.scene.bodies.size(); ++b) {
      const Body& body = world.scene.bodies[b];
      if (!body.haptic) continue;
      if (!world.meshes[b].haptic) throw std::invalid_argument("the haptic geometry of '" + body.name + "' is no mesh");
      if (world.meshes[b].haptic->adjacency.empty())
        throw std::invalid_argument("the haptic mesh of '" + body.name + "' has no adjacency");
      meshes_[b] = meshOf(world, b);
    }
  }

  ProxyContact touch(const RenderInput& in) noexcept override {
    Tool& tool = tools_[in.tool];
    in.near.use(Point::kGodObject);
    tool.near = &in.near;
    if (!tool.touching || !in.last.touching) face(in, tool);
    const ProxyMove moved = tool.place.triangle >= 0 ? walkTo(in.g, tool.place) : freeAt(in.g);
    tool.touching = moved.touching;
    ProxyContact contact = contactOf(moved, in.g);
    contact.swept = false;
    return contact;
  }
  const ProxyMover* mover() const noexcept override { return this; }

  /// Over the surface from x, which lies on it, to the point nearest to g.
  ProxyMove move(const Vec3& x, const Vec3& g, double r, Surroundings& near) const noexcept override {
    Place place = placeOf(x, r, near);
    if (place.triangle < 0) return freeAt(g);
    const ProxyMove moved = walkTo(g, place);
    if (Tool* tool = toolOf(near)) {
      tool->held = place.triangle;
      tool->held_at = moved.x;
    }
    return moved;
  }
  bool isSupported(const Vec3& x, double r, Surroundings& near) const noexcept override {
    return placeOf(x, r, near).triangle >= 0;
  }
  void changeFrame(std::size_t tool, const Pose& X_BA) noexcept override {
    tools_[tool].place.X_AG = X_BA * tools_[tool].place.X_AG;
  }
  std::string what() const override { return "walk over the mesh from triangle to triangle (friction cone algorithm)"; }

 private:
  static constexpr double kOn = 1e-6;  // relative to r: a point nearer than this lies on the surface

  /// The mesh of body b; bodies of one mesh share it.
  std::shared_ptr<const fca::WalkMesh> meshOf(const World& world, std::size_t b) const {
    for (std::size_t other = 0; other < b; ++other) {
      if (meshes_[other] && world.meshes[other].haptic == world.meshes[b].haptic) return meshes_[other];
    }
    return std::make_shared<const fca::WalkMesh>(*world.meshes[b].haptic);
  }

  /// The triangle nearest to x within `limit`.
  Place nearestTo(const Vec3& x, double limit, Surroundings& near) const noexcept {
    Place place;
    near.focus(x, limit);
    near.forEachWithin(x, limit, [&](const NearPiece& piece) {
      const Surroundings::Triangle found = near.triangleOf(piece.ref, x);
      if (piece.at.distance > limit || found.facet == nullptr) return;
      limit = piece.at.distance;
      place.mesh = meshes_[static_cast<std::size_t>(piece.body)].get();
      place.body = piece.body;
      place.triangle = found.facet->id;
      place.X_AG.q = Quat(near.turnOf(piece.ref));
      place.X_AG.p = x - place.X_AG.q * found.x_G;
    });
    return place;
  }

  Tool* toolOf(const Surroundings& near) const noexcept {
    const auto tool = std::ranges::find(tools_, &near, &Tool::near);
    return tool == tools_.end() ? nullptr : &*tool;
  }

  /// The place of x on the surface; no triangle when it is not on it. Friction's point is where it was left, or else
  /// where the tool touches; only after both the surroundings are searched.
  Place placeOf(const Vec3& x, double r, Surroundings& near) const noexcept {
    if (const Tool* tool = toolOf(near); tool != nullptr && tool->touching) {
      Place place = tool->place;
      if (tool->held >= 0 && x == tool->held_at) {
        place.triangle = tool->held;
        return place;
      }
      for (const std::int32_t triangle : {tool->held, tool->place.triangle}) {
        if (triangle < 0) continue;
        const Vec3 x_G = tool->place.X_AG.inverseTimes(x);
        const fca::SurfacePoint at = fca::walk(*tool->place.mesh, triangle, x_G);
        if (!((at.q - x_G).norm() <= kOn * r)) continue;
        place.triangle = at.triangle;
        return place;
      }
    }
    return nearestTo(x, kOn * r, near);
  }

  /// In free space: on the mesh that the tool faced in the last tick it starts from the triangle there, to enter by the
  /// side where it was; else from the nearest one.
  void face(const RenderInput& in, Tool& tool) const noexcept {
    constexpr double kRounding = 1e-9;
    const bool known = tool.place.triangle >= 0;
    Place nearest;
    if (known) nearest = nearestTo(in.g, (1 + kRounding) * distanceOf(tool.place, in.g), in.near);
    // none if another body carried that triangle, and has moved on
    if (nearest.triangle < 0) nearest = nearestTo(in.g, std::numeric_limits<double>::infinity(), in.near);
    const std::int32_t faced =
        tool.place.mesh == nearest.mesh && tool.place.body == nearest.body ? tool.place.triangle : -1;
    tool.place = nearest;
    if (faced >= 0) tool.place.triangle = faced;
    tool.held = -1;
    if (faced < 0 || walkTo(in.g, tool.place).touching) return;
    tool.place = nearest;
  }

  std::vector<std::shared_ptr<const fca::WalkMesh>> meshes_;  // by body; null: not touchable
  mutable std::vector<Tool> tools_;  // move() remembers where it ended: the next one begins there
};

const RendererPlugin kPlugin{.name = "fca_mesh",
                             .create = [](const PluginElement&, const World& world) -> std::unique_ptr<Renderer> {
                               return std::make_unique<FcaMesh>(world);
                             }};

}  // namespace
}  // namespace presa

PRESA_RENDERER_PLUGIN(presa::kPlugin)
