#pragma once
#include <cstddef>

#include "framework/haptics/sticking.h"
#include "framework/haptics/tool_renderer.h"
#include "framework/haptics/touched_solids.h"
#include "framework/haptics/virtual_coupling.h"
#include "modules/ray/ray_surroundings.h"

namespace presa {

/// Where one ray is held. Thread: haptic; nonblocking except for construction.
class RayProxy {
 public:
  static constexpr std::size_t kMaxPoints = 64;  ///< of contact in a step
  static constexpr double kMinStep = 2e-5;       ///< way that a part of a tick may make whatever the clearance [m]
  static constexpr double kMaxOverlap = 0.5;     ///< of the radius: max depth of a surface in the ray

  /// `stiffness`: of a point of contact [N/m]. `tool` is the same capsule as `ray`. All but the stiffness must outlive it.
  RayProxy(const Ray& ray, const ConvexSolid& tool, const RayBodies& bodies, const TouchedSolids& solids,
           const ToolCoupling& coupling, double stiffness);

  /// How a tick went.
  struct Step {
    bool whole = true;  ///< everything near was examined as finely as it is given
    bool exact = true;  ///< ray and forces are in balance
  };
  /// Moves the ray from X_WT to where springs and bodies hold it in this tick.
  Step step(const ToolInput& input, Pose& X_WT) noexcept;
  void reset() noexcept;  ///< starts anew, touching nothing

  /// After the step, from the tool's origin.
  const BoundedList<PressedPoint>& points() const noexcept { return points_; }
  const Sticking& sticking() const noexcept { return sticking_; }  ///< after the step
  /// Wrench of the handle about the tool's origin, after the step.
  const Vec6& ofHandle() const noexcept { return of_handle_; }
  double radius() const noexcept { return radius_; }  ///< of the ball around the tool's origin [m]

 private:
  void carry(Pose& X_WT) noexcept;
  /// Force of the handle on the ray at X_WT, which moved by `moved` in this tick.
  CouplingForce handleAt(const ToolInput& input, const Pose& X_WT, const Vec6& moved) const noexcept;
  /// Part of a tick in which the ray cannot come past a surface, and no point of it moves farther than `farthest` [m].
  /// True: it has arrived.
  bool move(const ToolInput& input, double farthest, Pose& X_WT, Vec6& moved, Step& result) noexcept;
  /// How settle() ended.
  struct Settled {
    bool exact = false;    ///< points and forces are in balance
    bool arrived = false;  ///< no bound cut the step short
  };
  /// Finds the step and its points. `u`: first that of the handle alone; `most`: how far the step may go [m].
  Settled settle(const ContactProblem& problem, const StepPoses& poses, double most, Vec6& u) noexcept;
  /// The part of the tick is taken back: the ray came too near to a surface.
  void stay(const ContactProblem& problem, const StepPoses& poses, Vec6& u) noexcept;
  double wayOf(const Vec6& step) const noexcept { return step.head<3>().norm() + radius_ * step.tail<3>().norm(); }

  const Ray& ray_;
  const TouchedSolids& solids_;
  const ToolCoupling& coupling_;
  RaySurroundings near_;
  double stiffness_, radius_;
  BoundedList<PressedPoint> points_, found_;  // of the step; of a look that no step uses
  Sticking sticking_;
  Vec6 of_handle_ = Vec6::Zero();
  Vec6 expected_ = Vec6::Zero();  // step of this tick, as that of the last one
  Vec3 friction_ = Vec3::Zero();  // of all points at the last look [N]
  std::size_t carrier_ = 0;       // solid that presses most
  bool carried_ = false;
  Pose X_WB_;  // of the carrier in the last tick
};

}  // namespace presa
