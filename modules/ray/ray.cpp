// A line in the hand, held by several bodies at once. Method: modules/ray/README.md.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/haptics/tool_renderer.h"
#include "framework/haptics/touched_solids.h"
#include "modules/ray/ray_proxy.h"

namespace presa {
namespace {

constexpr double kLever = 1e-3;  // distance below which two places share a torque only weakly [m]

/// Throws std::invalid_argument: a hand could press a surface so deep into the ray that it comes through.
void requireStiff(const Ray& ray, const DeviceRole& role, double stiffness) {
  const ToolCoupling& handle = role.tool->coupling;
  const double radius = std::max(ray.axis_T.a.norm(), ray.axis_T.b.norm()) + ray.radius;
  const double needed = TouchedSolids::maxSqueeze(handle, radius) / (RayProxy::kMaxOverlap * ray.radius);
  if (stiffness >= needed) return;
  char text[160];
  std::snprintf(text, sizeof text, "a stiffness of %.3g N/m lets surfaces into a ray of this radius: at least %.3g N/m",
                stiffness, needed);
  throw std::invalid_argument("the tool of '" + role.role + "': " + text);
}

class RayRenderer final : public ToolRenderer {
 public:
  RayRenderer(const PluginElement& settings, const World& world);
  void touch(const ToolInput& input, BoundedList<ToolForce>& forces, ToolState& state) noexcept override;
  std::size_t maxForces() const noexcept override { return RayProxy::kMaxPoints; }
  std::string what() const override;

 private:
  /// One tool of the scene.
  struct Held {
    Held(const Ray& made, ConvexSolid solid) : ray(made), capsule(std::move(solid)) {}
    Ray ray;
    ConvexSolid capsule;
    std::unique_ptr<RayProxy> proxy;
  };

  const Scene& scene_;
  double stiffness_;
  RayBodies bodies_;
  TouchedSolids solids_;
  std::vector<std::unique_ptr<Held>> held_;  // by device role; null: a fingertip
};

Ray rayOf(const DeviceRole& role) {
  const Geometry& geometry = role.tool->geometry;
  const auto* capsule = std::get_if<Capsule>(&geometry.shape);
  if (capsule == nullptr)
    throw std::invalid_argument("the tool of '" + role.role +
                                "' is no line: a ray is a <capsule>; light_cursor and pointshell take any shape");
  if (capsule->radius < 10 * RayProxy::kMinStep)
    throw std::invalid_argument("the tool of '" + role.role + "' is too thin for a ray: a radius of at least 0.2 mm");
  const Vec3 half(0, 0, 0.5 * capsule->length);
  return {{geometry.X_BG * Vec3(-half), geometry.X_BG * half}, capsule->radius};
}

RayRenderer::RayRenderer(const PluginElement& settings, const World& world)
    : scene_(world.scene), stiffness_(settings.number("stiffness")), bodies_(world), solids_(scene_, bodies_.bodies()) {
  for (std::size_t d = 0; d < scene_.devices.size(); ++d) {
    held_.push_back(nullptr);
    if (!scene_.devices[d].tool) continue;
    held_[d] = std::make_unique<Held>(rayOf(scene_.devices[d]), convexTool(world, d, {}));
    requireStiff(held_[d]->ray, scene_.devices[d], stiffness_);
    held_[d]->proxy = std::make_unique<RayProxy>(held_[d]->ray, held_[d]->capsule, bodies_, solids_,
                                                 scene_.devices[d].tool->coupling, stiffness_);
  }
}

void RayRenderer::touch(const ToolInput& input, BoundedList<ToolForce>& forces, ToolState& state) noexcept {
  RayProxy& proxy = *held_[input.tool]->proxy;
  solids_.place(input);
  if (!state.alive) proxy.reset();
  const RayProxy::Step step = proxy.step(input, state.X_WT);
  solids_.list(
      {scene_.devices[input.tool].tool->coupling, proxy.points(), proxy.sticking(), stiffness_, proxy.radius(), kLever},
      proxy.ofHandle(), forces);
  for (ToolForce& one : forces) one.p_W += state.X_WT.p;
  state.points = static_cast<std::uint32_t>(forces.size());
  state.coarse += step.whole ? 0 : 1;
  state.late += step.exact ? 0 : 1;
  state.depth = 0;
  for (const PressedPoint& one : proxy.points()) state.depth = std::max(state.depth, one.force / stiffness_);
}

std::string RayRenderer::what() const {
  std::size_t triangles = 0;
  for (const RayBodies::Mesh& mesh : bodies_.meshes) triangles += mesh.tree->mesh().triangles.size();
  return "hold lines off the bodies: shapes: " + std::to_string(bodies_.shapes.size()) +
         ", meshes: " + std::to_string(bodies_.meshes.size()) + ", of " + std::to_string(triangles) + " triangles";
}

const ToolRendererPlugin kPlugin{
    .name = "ray", .create = [](const PluginElement& settings, const World& world) -> std::unique_ptr<ToolRenderer> {
      return std::make_unique<RayRenderer>(settings, world);
    }};

}  // namespace
}  // namespace presa

PRESA_TOOL_RENDERER_PLUGIN(presa::kPlugin)
