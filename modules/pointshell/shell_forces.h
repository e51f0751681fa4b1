#pragma once
#include "framework/core/exchange/bounded_list.h"
#include "framework/haptics/gathered_forces.h"
#include "framework/haptics/tool_renderer.h"
#include "modules/pointshell/shell_contact.h"

namespace presa {

/// Few forces that stand for those of all points in contact, and whose sum is what the handle feels: the least change of
/// the points' own forces that gives this sum. In balance nothing changes; within a tick that did not reach it, the hand
/// still feels a smooth force, and the bodies its opposite. Thread: haptic; nonblocking.
class ShellForces {
 public:
  static constexpr std::size_t kMax = GatheredForces::kMax;  ///< on one tool

  /// False: the tool touches more bodies; the others bear their share.
  /// `stiffness`: of handle, tool and contact in series [N/m]. `wrench_T`: of all contacts on the tool, about its origin.
  static bool add(const BoundedList<TouchingPoint>& touching, const Pose& X_WT, const std::vector<Solid>& solids,
                  const std::vector<FrictionCoefficients>& friction, double stiffness, const Vec6& wrench_T,
                  BoundedList<ToolForce>& forces) noexcept;
};

}  // namespace presa
