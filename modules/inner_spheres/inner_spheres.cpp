// Inner spheres [Weller2009] with a static virtual coupling: in each tick Newton's method finds the pose at which the
// spring of the handle and the overlap of the spheres balance. Method: modules/inner_spheres/README.md.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/geometry/mesh_distance.h"
#include "framework/haptics/gathered_forces.h"
#include "framework/haptics/tool_renderer.h"
#include "modules/inner_spheres/sphere_pairs.h"

namespace presa {
namespace {

constexpr int kIterations = 12;
constexpr double kBalanced = 1e-6;    // residual relative to the coupling's limits
constexpr double kMaxMotion = 0.002;  // of a point of the tool in a tick near bodies [m]
constexpr double kAhead = 0.0005;     // beyond what the handle wants: a body may come towards the tool [m]
constexpr double kShorter = 0.5;      // of a step that did not help

double depthIn(const Primitive& primitive, const Vec3& p) {
  return -nearest(ConvexPiece{-1, -1, primitive}, p).distance;
}

/// Spheres in a solid; none if no sphere finds room.
std::vector<InnerSphere> spheresIn(const Geometry& geometry, const TriMesh* mesh, std::size_t count,
                                   const std::string& whose) {
  if (const std::optional<Primitive> primitive = primitiveOf(geometry)) {
    const double reach = boundingRadius(geometry.shape);
    if (primitive->kind == Primitive::Kind::kSphere) return {{primitive->X_AG.p, primitive->radius}};
    Primitive centred = *primitive;
    centred.X_AG = {};
    AxisBox box{Vec3::Constant(-reach), Vec3::Constant(reach)};
    if (primitive->kind == Primitive::Kind::kBox) box = {-primitive->half, primitive->half};
    if (primitive->kind == Primitive::Kind::kCylinder || primitive->kind == Primitive::Kind::kCapsule) {
      const double ends = primitive->kind == Primitive::Kind::kCapsule ? primitive->radius : 0;
      const Vec3 half(primitive->radius, primitive->radius, primitive->half_length + ends);
      box = {-half, half};
    }
    std::vector<InnerSphere> spheres = packSpheres([&](const Vec3& p) { return depthIn(centred, p); }, box, count);
    for (InnerSphere& one : spheres) one.centre = primitive->X_AG * one.centre;
    return spheres;
  }
  const MeshReport report = checkMesh(*mesh);
  if (!report.closed() || report.flipped_edges > 0)
    throw std::invalid_argument("the mesh of " + whose + " is open or folded (" + std::to_string(report.open_edges) +
                                " open edges): spheres need an inside; close the mesh, or give a primitive");
  const MeshDistance distance(*mesh);
  return packSpheres([&](const Vec3& p) { return -distance(p); }, boundsOf(*mesh), count);
}

class InnerSpheres final : public ToolRenderer {
 public:
  InnerSpheres(const PluginElement& settings, const World& world);
  void touch(const ToolInput& input, BoundedList<ToolForce>& forces, ToolState& state) noexcept override;
  std::size_t maxForces() const noexcept override { return GatheredForces::kMax; }
  std::string what() const override;

 private:
  /// One tool of the scene.
  struct Held {
    ToolCoupling coupling;
    SphereTree tree;
    std::unique_ptr<SpherePairs> pairs;
    double radius = 0;  // around the tool's origin [m]
  };
  /// A pose of the tool, and what acts on it there.
  struct Balance {
    Pose X_WT;
    Vec6 of_handle = Vec6::Zero(), residual = Vec6::Zero();
    Mat6 stiffness = Mat6::Zero();
    double unbalanced = std::numeric_limits<double>::infinity();  // in relation to the limits of the coupling
  };
  static Balance at(const ToolInput& input, const Pose& start, const Pose& X_WT, Held& held) noexcept;
  /// Moves the tool towards balance, by `margin` at most; it stays at the best pose on the way.
  static Balance settle(const ToolInput& input, const Pose& start, double margin, Held& held) noexcept;
  /// False: the tool touches more bodies than can be listed.
  bool write(const Held& held, const Balance& balance, BoundedList<ToolForce>& forces, ToolState& state) const noexcept;

  const Scene& scene_;
  std::vector<SphereSolid> solids_;
  std::vector<Pose> X_WB_;                    // by solid
  std::vector<std::unique_ptr<Held>> tools_;  // by device role; null: a fingertip
};

InnerSpheres::InnerSpheres(const PluginElement& settings, const World& world) : scene_(world.scene) {
  const auto count = static_cast<std::size_t>(settings.number("count"));
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
    const Body& body = scene_.bodies[b];
    if (!body.haptic) continue;
    std::vector<InnerSphere> spheres =
        spheresIn(*body.haptic, world.meshes[b].haptic.get(), count, "body '" + body.name + "'");
    // a mesh is given in its own frame
    if (!primitiveOf(*body.haptic)) {
      for (InnerSphere& one : spheres) one.centre = body.haptic->X_BG * one.centre;
    }
    if (spheres.empty())
      throw std::invalid_argument("no sphere finds room in body '" + body.name + "': it is too thin");
    solids_.push_back({static_cast<std::int32_t>(b), SphereTree(std::move(spheres))});
  }
  X_WB_.resize(solids_.size());
  for (std::size_t d = 0; d < scene_.devices.size(); ++d) {
    tools_.push_back(nullptr);
    if (!world.tools[d]) continue;
    const Tool& tool = *scene_.devices[d].tool;
    const std::string whose = "the tool of '" + scene_.devices[d].role + "'";
    std::vector<InnerSphere> spheres = spheresIn(tool.geometry, world.tools[d].get(), count, whose);
    if (spheres.empty()) throw std::invalid_argument("no sphere finds room in " + whose + ": it is too thin");
    tools_.back() =
        std::make_unique<Held>(Held{tool.coupling, SphereTree(std::move(spheres)), nullptr, radiusOf(*world.tools[d])});
    Held& held = *tools_.back();
    held.pairs = std::make_unique<SpherePairs>(held.tree, solids_, settings.number("stiffness"),
                                               static_cast<std::size_t>(settings.number("pairs_per_tick")));
  }
}

void InnerSpheres::touch(const ToolInput& input, BoundedList<ToolForce>& forces, ToolState& state) noexcept {
  Held& held = *tools_[input.tool];
  for (std::size_t s = 0; s < solids_.size(); ++s) X_WB_[s] = input.touchables.frameOf(solids_[s].body);
  const Pose start = state.alive ? state.X_WT : input.X_WH;
  const double way = (input.X_WH.p - start.p).norm() + turnBetween(start.q, input.X_WH.q).norm() * held.radius;
  state.points = 0;
  state.depth = 0;
  state.X_WT = input.X_WH;
  if (held.pairs->clearance(start, X_WB_) > way + kAhead) return;
  const double margin = std::min(way, kMaxMotion) + kAhead;
  const bool whole = held.pairs->gather(start, X_WB_, margin);
  const Balance balance = settle(input, start, margin, held);
  state.late += balance.unbalanced <= kBalanced ? 0 : 1;
  state.X_WT = balance.X_WT;
  const bool complete = write(held, balance, forces, state);
  state.coarse += whole && complete ? 0 : 1;
}

InnerSpheres::Balance InnerSpheres::at(const ToolInput& input, const Pose& start, const Pose& X_WT,
                                       Held& held) noexcept {
  Vec6 moved, handle;
  moved << X_WT.p - start.p, turnBetween(start.q, X_WT.q);
  handle << input.v_WH, input.w_WH;
  const CouplingForce force =
      couplingForce(held.coupling, input.X_WH, X_WT, moved - input.period * handle, input.period);
  Balance balance{.X_WT = X_WT, .of_handle = force.wrench, .stiffness = force.stiffness};
  balance.residual = force.wrench + held.pairs->evaluate(X_WT, balance.stiffness);
  balance.unbalanced = std::max(balance.residual.head<3>().norm() / held.coupling.max_force,
                                balance.residual.tail<3>().norm() / held.coupling.max_torque);
  return balance;
}

InnerSpheres::Balance InnerSpheres::settle(const ToolInput& input, const Pose& start, double margin,
                                           Held& held) noexcept {
  Balance best = at(input, start, start, held);
  double left = margin, part = 1;
  for (int iteration = 0; iteration < kIterations && best.unbalanced > kBalanced && left > 0; ++iteration) {
    Vec6 step = part * best.stiffness.ldlt().solve(best.residual);
    const double way = step.head<3>().norm() + step.tail<3>().norm() * held.radius;
    if (way > left) step *= left / way;
    const Balance next = at(input, start, movedBy(best.X_WT, step), held);
    const bool helps = next.unbalanced < best.unbalanced;
    part = helps ? std::min(1.0, 2 * part) : kShorter * part;
    if (!helps) continue;
    left -= std::min(way, left);
    best = next;
  }
  held.pairs->evaluate(best.X_WT, best.stiffness);  // the forces there
  return best;
}

bool InnerSpheres::write(const Held& held, const Balance& balance, BoundedList<ToolForce>& forces,
                         ToolState& state) const noexcept {
  const auto small = [](const SpherePair& one) {
    return SmallForce{one.solid, one.p, one.f_W.normalized(), one.f_W, true};
  };
  GatheredForces gathered;
  bool complete = true;
  for (const SpherePair& one : held.pairs->pairs()) {
    if (one.f_W.isZero()) continue;
    ++state.points;
    complete = gathered.weigh(small(one)) && complete;
    const double apart = (balance.X_WT * one.tool_T - one.body_W).norm();
    state.depth = std::max(state.depth, one.tool_radius + one.body_radius - apart);
  }
  for (const SpherePair& one : held.pairs->pairs()) {
    if (!one.f_W.isZero()) gathered.add(small(one));
  }
  gathered.write(
      held.coupling.stiffness, -balance.of_handle,
      [&](std::uint32_t solid, ToolForce& force) { force.body = solids_[solid].body; }, forces);
  for (ToolForce& one : forces) one.p_W += balance.X_WT.p;
  return complete;
}

std::string InnerSpheres::what() const {
  std::size_t of_bodies = 0, of_tools = 0;
  for (const SphereSolid& solid : solids_) of_bodies += solid.tree.sphereCount();
  for (const auto& held : tools_) of_tools += held ? held->tree.sphereCount() : 0;
  return "hold tools off the bodies by the volume in which spheres overlap: " + std::to_string(of_tools) +
         " in the tools against " + std::to_string(of_bodies) + " in " + std::to_string(solids_.size()) + " bodies";
}

const ToolRendererPlugin kPlugin{
    .name = "inner_spheres",
    .create = [](const PluginElement& settings, const World& world) -> std::unique_ptr<ToolRenderer> {
      return std::make_unique<InnerSpheres>(settings, world);
    }};

}  // namespace
}  // namespace presa

PRESA_TOOL_RENDERER_PLUGIN(presa::kPlugin)
