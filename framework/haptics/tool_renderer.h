#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/exchange/bounded_list.h"
#include "framework/haptics/tool_field.h"
#include "framework/haptics/touchables.h"
#include "framework/plugin/plugin_loader.h"
#include "framework/scene/plugin_element.h"
#include "framework/scene/tool_state.h"
#include "framework/scene/world.h"

namespace presa {

/// Force of one body on a tool, at one point.
struct ToolForce {
  std::int32_t body = kNoBody;  ///< index into Scene::bodies
  Vec3 p_W = Vec3::Zero();      ///< where it acts [m]
  Vec3 nhat_W = Vec3::UnitZ();  ///< unit, body into tool
  Vec3 f_W = Vec3::Zero();      ///< on the tool, friction included [N]
  double stiffness = 0;         ///< of handle, tool and contact in series, as the body feels it [N/m], > 0
  double friction_static = 0;   ///< bound of tangential over normal force while sticking
  double friction_dynamic = 0;  ///< the same while slipping
  bool slips = false;           ///< friction does not hold it
};

/// One tool in one haptic tick, in the world frame.
struct ToolInput {
  std::size_t tool;                        ///< index of the scene's device role
  const Pose& X_WH;                        ///< the handle: where the device is
  const Vec3& v_WH;                        ///< its velocity [m/s]
  const Vec3& w_WH;                        ///< its angular velocity [rad/s]
  double period;                           ///< of the haptic tick [s]
  const Touchables& touchables;            ///< poses of the bodies in this tick
  const std::vector<Material>& materials;  ///< as Scene::materials, with what commands changed
};

/// Says where each tool is held by the bodies, and which forces hold it there. The device feels exactly the sum of these
/// forces, with that of the tool's inertia in its state, and each body the opposite of its own.
/// Thread: haptic, except for construction and what(); no allocation, lock, exception or system call.
class ToolRenderer {
 public:
  virtual ~ToolRenderer() = default;
  /// Adds the forces to `forces` (empty, with room for maxForces()) and updates `state`, which the last tick left, its
  /// f_H_W and t_H_W zeroed. A force that is not finite, or of no body, ends the run: forces go to zero, and the fault
  /// is reported with the renderer's name.
  virtual void touch(const ToolInput& input, BoundedList<ToolForce>& forces, ToolState& state) noexcept = 0;
  /// Maximum number of forces on one tool.
  virtual std::size_t maxForces() const noexcept = 0;
  /// Description for `presa explain`.
  virtual std::string what() const = 0;
};

/// Table of a tool renderer's plug-in. Its manifest (framework/scene/manifest.h) makes its name a value of the attribute
/// `tools` of `<haptics>`; an element of the manifest, if it has one, stands in `<haptics>` and has defaults for all its
/// attributes.
struct ToolRendererPlugin {
  int abi = kPluginAbi;  ///< leave it as it is: another version is refused (E510)
  const char* name;      ///< as in the manifest
  /// May throw (E596). The world stays alive as long as the renderer.
  std::unique_ptr<ToolRenderer> (*create)(const PluginElement& settings, const World& world);
  /// The distances that such a renderer looks up, by body; null: it looks up none. Thread: view. As create.
  std::vector<ToolField> (*fields)(const PluginElement& settings, const World& world) = nullptr;
};

}  // namespace presa

/// Exports `table`, a ToolRendererPlugin that lives as long as the library. Once in a plug-in, outside of namespaces.
#define PRESA_TOOL_RENDERER_PLUGIN(table)                                                                        \
  extern "C" __attribute__((visibility("default"))) const presa::ToolRendererPlugin* presaToolRendererPlugin() { \
    return &(table);                                                                                             \
  }
