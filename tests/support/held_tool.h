#pragma once
#include <memory>
#include <string>

#include "framework/core/math/spatial.h"
#include "framework/scene/tool_state.h"

namespace presa::test {

/// A tool with volume that one tool renderer holds off a fixed body at the origin, without a run. The elements are read
/// like any scene's, with the plug-ins' manifests:
///
///     HeldTool ball("<haptics tools=\"pointshell\"/>", "<tool><sphere radius=\"0.01\"/></tool>",
///                   "<box size=\"0.1 0.1 0.1\"/>");
///     ball.force({{0, 0, 0.1}, Quat::Identity()});
///     EXPECT_GT(ball.force({{0, 0, 0.058}, Quat::Identity()}).z(), 1.9);
class HeldTool {
 public:
  /// `haptics`: the scene's `<haptics>`; `tool`: the `<tool>` of the device; `shape`: the haptic geometry of the body,
  /// whose material has the coefficients of friction 0.5 and 0.4. Throws InputError with every finding.
  HeldTool(const std::string& haptics, const std::string& tool, const std::string& shape);
  ~HeldTool();

  /// One tick of 1 ms with the handle at X_WH. Returns the sum of the forces on the tool [N], which the hand feels; NaN
  /// if the renderer breaks its contract. In the first tick the tool should be free.
  /// Nonblocking if the plug-in is: put a RealTimeGuard around it.
  Vec3 force(const Pose& X_WH) noexcept;
  const ToolState& state() const noexcept;  ///< after that tick

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace presa::test
