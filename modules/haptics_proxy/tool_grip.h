#pragma once
#include "framework/core/state/device_state.h"
#include "framework/geometry/tri_mesh.h"
#include "framework/scene/tool_state.h"

namespace presa {

/// The hand on a tool that a button puts down and picks up (Tool::put_down). Put down, the tool stays where it is; its
/// force fades first. Picked up from near it, it is held as it lies. Thread: haptic; nonblocking.
class ToolGrip {
 public:
  static constexpr double kFade = 0.05;    ///< of the force of a tool that is put down [s]
  static constexpr double kReach = 0.015;  ///< a handle this near to the box around the tool picks it up [m]

  /// `box_T`: around the tool, in its frame.
  ToolGrip(int button, const AxisBox& box_T) : bit_(1U << static_cast<unsigned>(button)), box_T_(box_T) {}
  /// Once a tick. Sets `state`: lies, X_HT; not alive in the tick in which it is picked up, at X_WT. Returns the share of its
  /// force that acts.
  double step(const FingerInput& input, double period, ToolState& state) noexcept;

 private:
  void pickUp(const Pose& X_WH, ToolState& state) noexcept;

  std::uint32_t bit_;
  AxisBox box_T_;
  bool pressed_ = false;
  double fade_ = -1;  // time that is left of it [s]; negative: the tool is held, or lies
};

}  // namespace presa
