#include "tests/support/held_tool.h"

#include <limits>

#include "framework/haptics/renderers.h"
#include "framework/haptics/virtual_coupling.h"
#include "tests/support/finger_world.h"

namespace presa::test {
namespace {

constexpr double kTick = 1e-3;  // [s]

std::shared_ptr<const World> worldOf(const std::string& haptics, const std::string& tool, const std::string& shape) {
  return fingerWorld(R"(<scene version="1.1" name="held"><world gravity="0 0 0"/>)" + haptics +
                     R"(<materials><material name="any" stiffness="1000"><friction static="0.5" dynamic="0.4"/>
    </material></materials><body name="body" fixed="true" material="any"><haptic>)" +
                     shape + R"(</haptic></body><devices><device role="finger">)" + tool +
                     "</device></devices></scene>");
}

}  // namespace

struct HeldTool::Parts {
  Parts(const std::string& haptics, const std::string& tool, const std::string& shape)
      : world(worldOf(haptics, tool, shape)),
        renderer(makeToolRenderer(*world)),
        touchables(*world),
        forces(renderer->maxForces()) {}
  std::shared_ptr<const World> world;
  std::unique_ptr<ToolRenderer> renderer;
  Touchables touchables;
  BoundedList<ToolForce> forces;
  ToolState state;
  Pose last_X_WH;
};

HeldTool::HeldTool(const std::string& haptics, const std::string& tool, const std::string& shape)
    : parts_(std::make_unique<Parts>(haptics, tool, shape)) {}
HeldTool::~HeldTool() = default;
const ToolState& HeldTool::state() const noexcept { return parts_->state; }

Vec3 HeldTool::force(const Pose& X_WH) noexcept {
  Parts& p = *parts_;
  if (!p.state.alive) p.last_X_WH = p.state.X_WT = X_WH;
  const Vec3 v_WH = (X_WH.p - p.last_X_WH.p) / kTick, w_WH = turnBetween(p.last_X_WH.q, X_WH.q) / kTick;
  p.last_X_WH = X_WH;
  p.forces.clear();
  p.renderer->touch({0, X_WH, v_WH, w_WH, kTick, p.touchables, p.world->scene.materials}, p.forces, p.state);
  p.state.alive = true;
  if (p.forces.lost() > 0 || !keepsContract(p.forces, p.state.X_WT, p.touchables))
    return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec3 sum = Vec3::Zero();
  for (const ToolForce& one : p.forces) sum += one.f_W;
  return sum;
}

}  // namespace presa::test
