// Light cursor [Harwin & Barrow 2013, 4.1.2]: each tool is a light rigid body on the spring and damper of its handle, which
// a contact problem holds off the bodies. Method: modules/light_cursor/README.md.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "framework/haptics/balanced_forces.h"
#include "framework/haptics/tool_renderer.h"
#include "modules/light_cursor/cursor.h"

namespace presa {
namespace {

constexpr int kBounce = 10;        // ticks without contact after which the hand feels nothing
constexpr double kMaxSqueeze = 4;  // of a body, in relation to what the handle can press with all its levers

class LightCursor final : public ToolRenderer {
 public:
  LightCursor(const PluginElement& settings, const World& world);
  void touch(const ToolInput& input, BoundedList<ToolForce>& forces, ToolState& state) noexcept override;
  std::size_t maxForces() const noexcept override { return law_.max_contacts; }
  std::string what() const override;

 private:
  void place(const ToolInput& input) noexcept;
  /// One tool of the scene.
  struct Held {
    Cursor cursor;
    int bounce = kBounce;  // ticks since the last one with contacts
  };
  /// The contacts of this tick; false: there are none.
  bool list(const ToolCoupling& coupling, const Cursor& cursor, BoundedList<ToolForce>& forces) noexcept;
  void write(const ToolInput& input, Held& held, BoundedList<ToolForce>& forces, ToolState& state) noexcept;

  const Scene& scene_;
  CursorLaw law_;
  std::vector<ConvexSolid> bodies_, tools_;
  std::vector<Pose> X_WB_;                      // by body of bodies_
  std::vector<FrictionCoefficients> friction_;  // the same
  std::vector<double> pressure_;                // the same: sum of the forces on it [N]
  std::vector<std::unique_ptr<Held>> held_;     // by device role; null: a fingertip
};

LightCursor::LightCursor(const PluginElement& settings, const World& world)
    : scene_(world.scene),
      law_{settings.number("mass"), settings.number("stiffness"),
           static_cast<std::size_t>(settings.number("max_contacts"))},
      bodies_(convexBodies(world, partSettings(settings))),
      tools_(scene_.devices.size()),
      X_WB_(bodies_.size()),
      friction_(bodies_.size()),
      pressure_(bodies_.size()) {
  for (std::size_t d = 0; d < scene_.devices.size(); ++d) {
    held_.push_back(nullptr);
    if (!world.tools[d]) continue;
    tools_[d] = convexTool(world, d, partSettings(settings));
    const Cursor cursor(tools_[d], bodies_, friction_, scene_.devices[d].tool->coupling,
                        massProperties(*world.tools[d]), law_);
    held_.back() = std::make_unique<Held>(Held{cursor});
  }
}

void LightCursor::place(const ToolInput& input) noexcept {
  for (std::size_t s = 0; s < bodies_.size(); ++s) {
    const auto body = static_cast<std::size_t>(bodies_[s].body);
    const Material& material = input.materials[scene_.bodies[body].material];
    X_WB_[s] = input.touchables.frameOf(bodies_[s].body);
    friction_[s] = {material.friction_static, material.friction_dynamic};
  }
}

void LightCursor::touch(const ToolInput& input, BoundedList<ToolForce>& forces, ToolState& state) noexcept {
  Held& held = *held_[input.tool];
  place(input);
  if (!state.alive) {
    held.cursor.reset();
    held.bounce = kBounce;
  }
  const Cursor::Step step = held.cursor.step(input, X_WB_, state.X_WT);
  write(input, held, forces, state);
  state.points = static_cast<std::uint32_t>(forces.size());
  state.coarse += step.whole ? 0 : 1;
  state.late += step.exact ? 0 : 1;
  state.depth = 0;
  for (const CursorContact& one : held.cursor.contacts())
    state.depth = std::max(state.depth, one.force / law_.stiffness);
}

bool LightCursor::list(const ToolCoupling& coupling, const Cursor& cursor, BoundedList<ToolForce>& forces) noexcept {
  std::fill(pressure_.begin(), pressure_.end(), 0.0);
  double sum = 0;
  for (const CursorContact& one : cursor.contacts()) {
    pressure_[one.solid] += one.force;
    sum += one.force;
  }
  if (!(sum > 0)) return false;
  const double most = kMaxSqueeze * (coupling.max_force + coupling.max_torque / cursor.radius());
  const double stiffness = coupling.stiffness * law_.stiffness / (coupling.stiffness + law_.stiffness);
  for (const CursorContact& one : cursor.contacts()) {
    if (!(one.force > 0)) continue;
    const double scale = std::min(1.0, most / pressure_[one.solid]);
    forces.add({.body = bodies_[one.solid].body,
                .p_W = one.p,
                .nhat_W = one.nhat,
                .f_W = scale * (one.force * one.nhat + one.friction),
                .stiffness = stiffness * one.force / sum,
                .friction_static = friction_[one.solid].mu_static,
                .friction_dynamic = friction_[one.solid].mu_dynamic,
                .slips = cursor.sticking().slides(one)});
  }
  return true;
}

// The hand feels the spring of the handle, and the forces on the bodies add up to it. Where a jam comes free, so light a
// tool bounces for some ticks, while that spring is still tight: then it accelerates the tool alone.
void LightCursor::write(const ToolInput& input, Held& held, BoundedList<ToolForce>& forces, ToolState& state) noexcept {
  const Vec6& of_handle = held.cursor.ofHandle();
  const bool touches = list(scene_.devices[input.tool].tool->coupling, held.cursor, forces);
  held.bounce = touches ? 0 : std::min(kBounce, held.bounce + 1);
  if (touches) {
    balanceForces(forces, -of_handle);
    for (ToolForce& one : forces) one.p_W += state.X_WT.p;
  } else if (held.bounce < kBounce) {
    const double part = 1 - static_cast<double>(held.bounce) / kBounce;
    state.f_H_W = -part * of_handle.head<3>();
    state.t_H_W = -part * (of_handle.tail<3>() + (state.X_WT.p - input.X_WH.p).cross(Vec3(of_handle.head<3>())));
  }
}

std::string LightCursor::what() const {
  std::size_t parts = 0;
  for (const ConvexSolid& tool : tools_) parts += tool.parts.size();
  return "hold tools off the bodies as light bodies of " + std::to_string(parts) + " convex parts: " + textOf(bodies_);
}

const ToolRendererPlugin kPlugin{
    .name = "light_cursor",
    .create = [](const PluginElement& settings, const World& world) -> std::unique_ptr<ToolRenderer> {
      return std::make_unique<LightCursor>(settings, world);
    }};

}  // namespace
}  // namespace presa

PRESA_TOOL_RENDERER_PLUGIN(presa::kPlugin)
