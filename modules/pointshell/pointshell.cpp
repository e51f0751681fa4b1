// Voxmap-pointshell [McNeely1999] with a static virtual coupling [Wan2003, Barbic2008]: the tool has no mass; in each
// tick Newton's method finds the pose at which the spring of the handle and the contacts balance. Equations:
// modules/pointshell/README.md.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "framework/haptics/tool_renderer.h"
#include "framework/haptics/virtual_coupling.h"
#include "modules/pointshell/shell_contact.h"
#include "modules/pointshell/shell_forces.h"

namespace presa {
namespace {

constexpr int kIterations = 10;        // of Newton's method in a tick
constexpr double kBalanced = 1e-6;     // residual relative to the coupling's limits
constexpr double kNearly = 1e-4;       // the same, where another iteration no longer helps
constexpr double kStepVoxels = 0.5;    // max motion of a point in an iteration: no wall is thinner
constexpr double kExactStep = 0.0002;  // the same where all bodies are primitives [m]
constexpr double kMarginVoxels = 4;    // points this near are looked at, at the most
constexpr double kAheadVoxels = 2;     // looked beyond that, so that the next ticks need not look again
constexpr double kDamped = 0.5;        // of the last step, where the next one goes back
constexpr int kPatience = 3;           // ticks out of balance in a row before a tool leaves its best pose
constexpr double kOnItsWay = 2;        // motion in a tick, over that of an iteration, that leads somewhere
constexpr double kNormalsHold = 0.2;   // of the max motion in an iteration: the normals of a smaller one stay
constexpr std::size_t kMiB = std::size_t{1} << 20U;

/// One tool of the scene.
struct Held {
  ToolCoupling coupling;
  PointShell shell;
  std::unique_ptr<ShellContact> contact;
  std::int32_t frame = kNoBody;  // body that it touches; its pose is kept in the coordinates of that body
  Pose X_AT;
  int late = 0;  // ticks in a row without balance
};

class PointShellRenderer final : public ToolRenderer {
 public:
  PointShellRenderer(const PluginElement& settings, const World& world);
  void touch(const ToolInput& input, BoundedList<ToolForce>& forces, ToolState& state) noexcept override;
  std::size_t maxForces() const noexcept override { return ShellForces::kMax; }
  std::string what() const override;

 private:
  void place(const ToolInput& input) noexcept;
  /// A pose of the tool, and what acts on it there, in T about its origin.
  struct Balance {
    Pose X_WT;
    Vec6 wrench_T = Vec6::Zero(), residual_T = Vec6::Zero();  // of the handle; with that of the contacts
    Mat6 stiffness_T = Mat6::Zero();
  };
  /// Evaluates all forces at at.X_WT, if the tick began at `start`. Returns the residual relative to the limits of the
  /// coupling.
  double unbalanced(const ToolInput& input, const Pose& start, Held& held, Balance& at) const noexcept;
  /// Max motion of a point in an iteration [m].
  double longestStep(const Held& held, const Balance& at) const noexcept;
  /// Moves the tool towards balance; whether it got there. If not, it stays at the best pose on the way.
  bool settle(const ToolInput& input, Held& held, Balance& at) const noexcept;

  const Scene& scene_;
  ShellLaw law_;
  std::vector<Solid> solids_;
  double step_ = kExactStep;                    // max motion of a point in an iteration [m]
  std::vector<Pose> X_WB_;                      // by solid
  std::vector<FrictionCoefficients> friction_;  // by solid
  std::vector<std::unique_ptr<Held>> tools_;    // by device role; null: a fingertip
};

PointShellRenderer::PointShellRenderer(const PluginElement& settings, const World& world)
    : scene_(world.scene),
      law_{settings.number("stiffness"), settings.boolean("printed"),
           static_cast<std::size_t>(settings.number("points_per_tick"))},
      solids_(solidsOf(world, {settings.number("voxel"),
                               static_cast<std::size_t>(settings.number("memory") * static_cast<double>(kMiB))})),
      X_WB_(solids_.size()),
      friction_(solids_.size()) {
  for (const Solid& solid : solids_) {
    if (solid.voxel() > 0 && (step_ == kExactStep || kStepVoxels * solid.voxel() < step_))
      step_ = kStepVoxels * solid.voxel();
  }
  for (std::size_t d = 0; d < scene_.devices.size(); ++d) {
    tools_.push_back(nullptr);
    if (!world.tools[d]) continue;
    auto held = std::make_unique<Held>();
    held->coupling = scene_.devices[d].tool->coupling;
    held->shell = PointShell(*world.tools[d], std::max(1e-9, settings.number("spacing")),
                             static_cast<std::size_t>(settings.number("max_points")));
    held->contact = std::make_unique<ShellContact>(held->shell, solids_, X_WB_, friction_, law_);
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
  Held& held = *tools_[input.tool];
  place(input);
  Pose X_WT = state.alive ? input.touchables.frameOf(held.frame) * held.X_AT : input.X_WH;
  const double way = (input.X_WH.p - X_WT.p).norm() + turnBetween(X_WT.q, input.X_WH.q).norm() * held.shell.radius();
  const double max = kMarginVoxels / kStepVoxels * step_, margin = std::min(way, max) + step_;
  state.points = 0;
  state.depth = 0;
  held.frame = kNoBody;
  if (!state.alive) held.contact->letGo();
  if (held.contact->clearance(X_WT) > way) {
    held.contact->letGo();
    X_WT = input.X_WH;
  } else {
    const bool whole = held.contact->gather(X_WT, margin, kAheadVoxels / kStepVoxels * step_);
    Balance at{.X_WT = X_WT};
    const bool balanced = settle(input, held, at);
    held.late = balanced ? 0 : held.late + 1;
    state.late += balanced ? 0 : 1;
    X_WT = at.X_WT;
    for (const TouchingPoint& one : held.contact->touching()) state.depth = std::max(state.depth, one.depth);
    state.points = static_cast<std::uint32_t>(held.contact->touching().size());
    const ToolCoupling& coupling = held.coupling;
    const bool complete = ShellForces::add(held.contact->touching(), X_WT, solids_, friction_,
                                           coupling.stiffness * law_.stiffness / (coupling.stiffness + law_.stiffness),
                                           -at.wrench_T, forces);
    state.coarse += whole && complete ? 0 : 1;  // once a tick
    held.contact->keepHolds();
    if (!forces.empty()) held.frame = forces[0].body;
  }
  held.X_AT = input.touchables.frameOf(held.frame).inverse() * X_WT;
  state.X_WT = X_WT;
}

double PointShellRenderer::unbalanced(const ToolInput& input, const Pose& start, Held& held,
                                      Balance& at) const noexcept {
  Vec6 moved, handle;
  moved << at.X_WT.p - start.p, turnBetween(start.q, at.X_WT.q);
  handle << input.v_WH, input.w_WH;
  CouplingForce force = couplingForce(held.coupling, input.X_WH, at.X_WT, moved - input.period * handle, input.period);
  const Mat3 R_TW = at.X_WT.q.conjugate().toRotationMatrix();
  at.wrench_T << R_TW * force.wrench.head<3>(), R_TW * force.wrench.tail<3>();
  at.residual_T = at.wrench_T + held.contact->evaluate(at.X_WT, force.stiffness);
  at.stiffness_T = force.stiffness;
  return std::max(at.residual_T.head<3>().norm() / held.coupling.max_force,
                  at.residual_T.tail<3>().norm() / held.coupling.max_torque);
}

// In the air, up to the surface and as deep as the handle can press there.
double PointShellRenderer::longestStep(const Held& held, const Balance& at) const noexcept {
  const double near = held.contact->nearest();
  if (!(near > 0)) return step_;
  const double press = at.wrench_T.head<3>().norm() + 4 * at.wrench_T.tail<3>().norm() / held.shell.radius();
  return near + std::min(step_, 2 * press / law_.stiffness);
}

bool PointShellRenderer::settle(const ToolInput& input, Held& held, Balance& at) const noexcept {
  const Pose start = at.X_WT;
  double left = kMarginVoxels / kStepVoxels * step_;  // way within which all points are known
  Pose best = start, touched = start;                 // the latter: the last one in contact
  double before = std::numeric_limits<double>::infinity(), least = before;
  Vec6 last = Vec6::Zero();
  double last_way = 0;
  held.contact->forgetNormals();
  for (int iteration = 0;; ++iteration) {
    const double now = unbalanced(input, start, held, at);
    if (now <= kBalanced || (now <= kNearly && now > 0.5 * before)) return true;
    if (now < least) {
      least = now;
      best = at.X_WT;
    }
    if (!held.contact->touching().empty()) touched = at.X_WT;
    if (iteration == kIterations || left <= 0) break;
    before = now;
    Vec6 step = at.stiffness_T.partialPivLu().solve(at.residual_T);
    const double way = step.head<3>().norm() + step.tail<3>().norm() * held.shell.radius();
    double max = std::min(left, longestStep(held, at));
    // there and back again where points come and go: meet in the middle
    if (last.dot(step) < 0) max = std::min(max, kDamped * last_way);
    if (way > max) step *= max / way;
    last = step;
    last_way = std::min(way, max);
    left -= last_way;
    if (way > kNormalsHold * step_) held.contact->forgetNormals();
    const Mat3 R_WT = at.X_WT.q.toRotationMatrix();
    at.X_WT = movedBy(at.X_WT, (Vec6() << R_WT * step.head<3>(), R_WT * step.tail<3>()).finished());
  }
  // To and fro, it stays at the best pose. If it is late for some ticks and gets away from there, over an edge for
  // instance, it goes on.
  const double gone = (touched.p - start.p).norm() + turnBetween(start.q, touched.q).norm() * held.shell.radius();
  const bool balanced = least <= kNearly;
  at.X_WT = !balanced && held.late >= kPatience && gone > kOnItsWay * step_ ? touched : best;
  unbalanced(input, start, held, at);
  return balanced;
}

std::string PointShellRenderer::what() const {
  std::size_t points = 0, bytes = 0;
  for (const auto& held : tools_) points += held ? held->shell.size() : 0;
  for (const Solid& solid : solids_) bytes += (solid.field ? solid.field->roomBytes() : 0);
  std::string text = "hold tools off the bodies: " + std::to_string(points) + " points against " +
                     std::to_string(solids_.size()) + " solids, " + std::to_string(bytes / kMiB) +
                     " MiB of distance fields";
  return law_.printed ? text + ", the lectures' law as printed" : text;
}

const ToolRendererPlugin kPlugin{
    .name = "pointshell",
    .create = [](const PluginElement& settings, const World& world) -> std::unique_ptr<ToolRenderer> {
      return std::make_unique<PointShellRenderer>(settings, world);
    }};

}  // namespace
}  // namespace presa

PRESA_TOOL_RENDERER_PLUGIN(presa::kPlugin)
