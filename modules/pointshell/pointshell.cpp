// Voxmap-pointshell [McNeely1999] with a virtual coupling that is static [Wan2003, Barbic2008] or, with a mass, dynamic
// [Otaduy2006]: in each tick Newton's method finds the pose at which the spring of the handle, the contacts and the
// inertia balance. Equations: modules/pointshell/README.md.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "framework/haptics/tool_renderer.h"
#include "modules/pointshell/balance.h"
#include "modules/pointshell/exact_surface.h"
#include "modules/pointshell/shell_forces.h"

namespace presa {
namespace {

constexpr double kStepVoxels = 0.5;    // max motion of a point in an iteration: no wall is thinner
constexpr double kExactStep = 0.0002;  // the same where all bodies are primitives [m]
constexpr double kAheadSteps = 4;      // looked beyond the motion of a tick, so that the next ones need not look again
constexpr std::size_t kMiB = std::size_t{1} << 20U;

class PointShellRenderer final : public ToolRenderer {
 public:
  PointShellRenderer(const PluginElement& settings, const World& world);
  void touch(const ToolInput& input, BoundedList<ToolForce>& forces, ToolState& state) noexcept override;
  std::size_t maxForces() const noexcept override { return ShellForces::kMax; }
  std::string what() const override;

 private:
  void place(const ToolInput& input) noexcept;
  /// Balances a tool that may touch solids within its `way` [m], and adds their forces.
  void touchSolids(const BalanceSearch& search, double way, HeldShell& held, Balance& at,
                   BoundedList<ToolForce>& forces, ToolState& state) const noexcept;

  const Scene& scene_;
  ShellLaw law_;
  std::vector<Solid> solids_;
  double step_ = kExactStep;                       // max motion of a point in an iteration [m]
  std::vector<Pose> X_WB_;                         // by solid
  std::vector<FrictionCoefficients> friction_;     // by solid
  std::vector<std::unique_ptr<HeldShell>> tools_;  // by device role; null: a fingertip
};

FieldSettings fieldsWanted(const PluginElement& settings) {
  return {settings.number("voxel"), static_cast<std::size_t>(settings.number("memory") * static_cast<double>(kMiB)),
          settings.number("shell_thickness")};
}

PointShellRenderer::PointShellRenderer(const PluginElement& settings, const World& world)
    : scene_(world.scene),
      law_{settings.number("stiffness"), settings.boolean("printed"),
           static_cast<std::size_t>(settings.number("points_per_tick"))},
      solids_(solidsOf(world, fieldsWanted(settings))),
      X_WB_(solids_.size()),
      friction_(solids_.size()) {
  for (const Solid& solid : solids_) {
    if (solid.voxel() > 0 && (step_ == kExactStep || kStepVoxels * solid.voxel() < step_))
      step_ = kStepVoxels * solid.voxel();
  }
  for (std::size_t d = 0; d < scene_.devices.size(); ++d) {
    tools_.push_back(nullptr);
    if (!world.tools[d]) continue;
    auto held = std::make_unique<HeldShell>();
    held->coupling = scene_.devices[d].tool->coupling;
    held->shell = PointShell(*world.tools[d], std::max(1e-9, settings.number("spacing")),
                             static_cast<std::size_t>(settings.number("max_points")),
                             exactSurfaceOf(scene_.devices[d].tool->geometry));
    held->contact = std::make_unique<ShellContact>(held->shell, solids_, X_WB_, friction_, law_);
    if (const double mass = settings.number("mass"); mass > 0) held->mass.emplace(mass, *world.tools[d]);
    tools_.back() = std::move(held);
  }
}

void PointShellRenderer::place(const ToolInput& input) noexcept {
  for (std::size_t s = 0; s < solids_.size(); ++s) {
    const auto body = static_cast<std::size_t>(solids_[s].body);
    const Material& material = input.materials[scene_.bodies[body].material];
    X_WB_[s] = input.touchables.frameOf(solids_[s].body);
    friction_[s] = {material.friction_static, material.friction_dynamic};
  }
}

void PointShellRenderer::touch(const ToolInput& input, BoundedList<ToolForce>& forces, ToolState& state) noexcept {
  HeldShell& held = *tools_[input.tool];
  place(input);
  const Pose start = state.alive ? input.touchables.frameOf(held.frame) * held.X_AT : input.X_WH;
  if (held.mass && !state.alive) held.mass->start(start, input.v_WH, input.w_WH);
  const BalanceSearch search(input, start, held, law_.stiffness, step_);
  Balance at = search.free();
  const double way = search.wayBetween(start, at.X_WT);
  state.points = 0;
  state.depth = 0;
  held.frame = kNoBody;
  if (!state.alive) held.contact->letGo();
  if (held.contact->clearance(start) > way) {
    held.contact->letGo();
  } else {
    touchSolids(search, way, held, at, forces, state);
    // a tool with mass goes on from where it was, whatever it touches
    if (!forces.empty() && !held.mass) held.frame = forces[0].body;
  }
  held.X_AT = input.touchables.frameOf(held.frame).inverse() * at.X_WT;
  state.X_WT = at.X_WT;
  if (!held.mass) return;
  state.f_H_W = at.X_WT.q * at.inertia_T.head<3>();
  state.t_H_W = at.X_WT.q * at.inertia_T.tail<3>() + (at.X_WT.p - input.X_WH.p).cross(state.f_H_W);
  held.mass->finish(at.X_WT, input.period);
}

void PointShellRenderer::touchSolids(const BalanceSearch& search, double way, HeldShell& held, Balance& at,
                                     BoundedList<ToolForce>& forces, ToolState& state) const noexcept {
  const double margin = std::min(way, BalanceSearch::kMarginSteps * step_) + step_;
  const bool whole = held.contact->gather(search.start(), margin, kAheadSteps * step_);
  const bool balanced = search.settle(at);
  held.late = balanced ? 0 : held.late + 1;
  state.late += balanced ? 0 : 1;
  for (const TouchingPoint& one : held.contact->touching()) state.depth = std::max(state.depth, one.depth);
  state.points = static_cast<std::uint32_t>(held.contact->touching().size());
  const ToolCoupling& coupling = held.coupling;
  const bool complete = ShellForces::add(held.contact->touching(), at.X_WT, solids_, friction_,
                                         coupling.stiffness * law_.stiffness / (coupling.stiffness + law_.stiffness),
                                         -at.wrench_T, forces);
  state.coarse += whole && complete ? 0 : 1;  // once a tick
  held.contact->keepHolds();
}

std::string PointShellRenderer::what() const {
  std::size_t points = 0, bytes = 0;
  for (const auto& held : tools_) points += held ? held->shell.size() : 0;
  for (const Solid& solid : solids_) bytes += (solid.field ? solid.field->roomBytes() : 0);
  std::string text = "hold tools off the bodies: " + std::to_string(points) + " points against " +
                     std::to_string(solids_.size()) + " solids, " + std::to_string(bytes / kMiB) +
                     " MiB of distance fields";
  if (std::any_of(tools_.begin(), tools_.end(), [](const auto& held) { return held && held->mass; }))
    text += ", tools with mass";
  return law_.printed ? text + ", the lectures' law as printed" : text;
}

std::vector<ToolField> fieldsOf(const PluginElement& settings, const World& world) {
  std::vector<ToolField> fields;
  for (const Solid& solid : solidsOf(world, fieldsWanted(settings)))
    fields.push_back({solid.body, solid.voxel(), [solid](const Vec3& p_B) { return solid.distance(p_B); }});
  return fields;
}

const ToolRendererPlugin kPlugin{
    .name = "pointshell",
    .create = [](const PluginElement& settings, const World& world) -> std::unique_ptr<ToolRenderer> {
      return std::make_unique<PointShellRenderer>(settings, world);
    },
    .fields = fieldsOf};

}  // namespace
}  // namespace presa

PRESA_TOOL_RENDERER_PLUGIN(presa::kPlugin)
