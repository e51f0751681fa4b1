#pragma once
#include <memory>
#include <optional>

#include "framework/haptics/tool_renderer.h"
#include "framework/haptics/virtual_coupling.h"
#include "modules/pointshell/shell_contact.h"
#include "modules/pointshell/tool_mass.h"

namespace presa {

/// One tool of the scene.
struct HeldShell {
  ToolCoupling coupling;
  PointShell shell;
  std::unique_ptr<ShellContact> contact;
  std::int32_t frame = kNoBody;  ///< body that it touches; its pose is kept in the coordinates of that body
  Pose X_AT;                     ///< its pose there
  std::optional<ToolMass> mass;  ///< none: static
  int late = 0;                  ///< ticks in a row without balance
};

/// A pose of a tool, and what acts on it there, in T about its origin.
struct Balance {
  Pose X_WT;
  Vec6 wrench_T = Vec6::Zero(), inertia_T = Vec6::Zero();  ///< of handle and inertia together; of inertia alone
  Vec6 residual_T = Vec6::Zero();                          ///< with that of the contacts
  Mat6 stiffness_T = Mat6::Zero();                         ///< resistance of all of them
};

/// One tick of one tool: finds the pose at which the spring of the handle, the contacts and the inertia balance, by
/// Newton's method. Thread: haptic; nonblocking.
class BalanceSearch {
 public:
  static constexpr double kMarginSteps = 8;  ///< max motion of a point in a tick, over that of an iteration

  /// From `start`, with contacts of `stiffness` [N/m] and no motion of a point above `step` [m] in an iteration.
  /// References must outlive it.
  BalanceSearch(const ToolInput& input, const Pose& start, HeldShell& held, double stiffness, double step) noexcept
      : input_(input), start_(start), held_(held), stiffness_(stiffness), step_(step) {}

  const Pose& start() const noexcept { return start_; }  ///< of the tick
  /// Where the tool goes that touches nothing.
  Balance free() const noexcept;
  /// Moves the tool from the start towards balance; whether it got there. If not, it stays at the best pose on the way.
  bool settle(Balance& at) const noexcept;
  /// How far the farthest point of the tool moves between two poses, at the most [m].
  double wayBetween(const Pose& from, const Pose& to) const noexcept;

 private:
  void pull(Balance& at) const noexcept;
  double unbalanced(Balance& at) const noexcept;
  double longestStep(const Balance& at) const noexcept;
  double relative(const Vec6& wrench) const noexcept;

  const ToolInput& input_;
  const Pose start_;
  HeldShell& held_;
  const double stiffness_, step_;
};

}  // namespace presa
