// Light cursor [Harwin & Barrow 2013, 4.1.2]: each tool is a light rigid body on the spring and damper of its handle, which
// a contact problem holds off the bodies. Method: modules/light_cursor/README.md.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "framework/haptics/tool_renderer.h"
#include "framework/haptics/touched_solids.h"
#include "modules/light_cursor/cursor.h"

namespace presa {
namespace {

constexpr int kBounce = 10;  // ticks without contact after which the hand feels nothing

std::vector<std::int32_t> bodiesOf(const std::vector<ConvexSolid>& solids) {
  std::vector<std::int32_t> bodies;
  for (const ConvexSolid& solid : solids) bodies.push_back(solid.body);
  return bodies;
}

class LightCursor final : public ToolRenderer {
 public:
  LightCursor(const PluginElement& settings, const World& world);
  void touch(const ToolInput& input, BoundedList<ToolForce>& forces, ToolState& state) noexcept override;
  std::size_t maxForces() const noexcept override { return law_.max_contacts; }
  std::string what() const override;

 private:
  /// One tool of the scene.
  struct Held {
    Cursor cursor;
    int bounce = kBounce;  // ticks since the last one with contacts
  };
  void write(const ToolInput& input, Held& held, BoundedList<ToolForce>& forces, ToolState& state) noexcept;

  const Scene& scene_;
  CursorLaw law_;
  std::vector<ConvexSolid> bodies_, tools_;
  TouchedSolids solids_;                     // as bodies_
  std::vector<std::unique_ptr<Held>> held_;  // by device role; null: a fingertip
};

LightCursor::LightCursor(const PluginElement& settings, const World& world)
    : scene_(world.scene),
      law_{settings.number("mass"), settings.number("stiffness"),
           static_cast<std::size_t>(settings.number("max_contacts"))},
      bodies_(convexBodies(world, partSettings(settings))),
      tools_(scene_.devices.size()),
      solids_(scene_, bodiesOf(bodies_)) {
  for (std::size_t d = 0; d < scene_.devices.size(); ++d) {
    held_.push_back(nullptr);
    if (!world.tools[d]) continue;
    tools_[d] = convexTool(world, d, partSettings(settings));
    const Cursor cursor(tools_[d], bodies_, solids_.friction(), scene_.devices[d].tool->coupling,
                        massProperties(*world.tools[d]), law_);
    held_.back() = std::make_unique<Held>(Held{cursor});
  }
}

void LightCursor::touch(const ToolInput& input, BoundedList<ToolForce>& forces, ToolState& state) noexcept {
  Held& held = *held_[input.tool];
  solids_.place(input);
  if (!state.alive) {
    held.cursor.reset();
    held.bounce = kBounce;
  }
  const Cursor::Step step = held.cursor.step(input, solids_.X_WB(), state.X_WT);
  write(input, held, forces, state);
  state.points = static_cast<std::uint32_t>(forces.size());
  state.coarse += step.whole ? 0 : 1;
  state.late += step.exact ? 0 : 1;
  state.depth = 0;
  for (const PressedPoint& one : held.cursor.contacts())
    state.depth = std::max(state.depth, one.force / law_.stiffness);
}

// The hand feels the spring of the handle, and the forces on the bodies add up to it. Where a jam comes free, so light a
// tool bounces for some ticks, while that spring is still tight: then it accelerates the tool alone.
void LightCursor::write(const ToolInput& input, Held& held, BoundedList<ToolForce>& forces, ToolState& state) noexcept {
  const Vec6& of_handle = held.cursor.ofHandle();
  const ToolCoupling& coupling = scene_.devices[input.tool].tool->coupling;
  const Cursor& cursor = held.cursor;
  const bool touches = solids_.list({coupling, cursor.contacts(), cursor.sticking(), law_.stiffness, cursor.radius()},
                                    of_handle, forces);
  held.bounce = touches ? 0 : std::min(kBounce, held.bounce + 1);
  if (touches) {
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
