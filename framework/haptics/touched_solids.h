#pragma once
#include <vector>

#include "framework/core/exchange/bounded_list.h"
#include "framework/haptics/sticking.h"
#include "framework/haptics/tool_renderer.h"

namespace presa {

/// The bodies that a tool may touch, numbered as solids by its renderer, and the forces of its points on them. Memory is
/// fixed after construction. Thread: haptic; nonblocking except for construction.
class TouchedSolids {
 public:
  /// `bodies`: index into Scene::bodies, by solid.
  TouchedSolids(const Scene& scene, std::vector<std::int32_t> bodies);

  /// Poses and coefficients of friction of this tick.
  void place(const ToolInput& input) noexcept;
  const std::vector<Pose>& X_WB() const noexcept { return X_WB_; }  ///< by solid, since place()
  /// By solid, since place(). The reference stays valid.
  const std::vector<FrictionCoefficients>& friction() const noexcept { return friction_; }

  /// Force with which points within `radius` of the tool's origin may press one body [N]: four times what the handle can
  /// press with all its levers.
  static double maxSqueeze(const ToolCoupling& handle, double radius) noexcept {
    return 4 * (handle.max_force + handle.max_torque / radius);
  }

  /// The tool whose points press.
  struct Pressing {
    const ToolCoupling& coupling;             ///< of its handle
    const BoundedList<PressedPoint>& points;  ///< after a step
    const Sticking& sticking;                 ///< after the same step
    double stiffness = 0;                     ///< of a point [N/m]
    double radius = 0;                        ///< of the ball around the tool's origin [m]
    double lever = 0;                         ///< places nearer to each other hardly give a torque [m]
  };
  /// Adds the points that press to `forces`, their places from the tool's origin, and balances them with `of_handle`, the
  /// wrench of the handle on the tool about its origin. No body is squeezed by more than maxSqueeze(). False: no point
  /// presses.
  bool list(const Pressing& tool, const Vec6& of_handle, BoundedList<ToolForce>& forces) noexcept;

 private:
  const Scene& scene_;
  std::vector<std::int32_t> bodies_;
  std::vector<Pose> X_WB_;
  std::vector<FrictionCoefficients> friction_;
  std::vector<double> pressure_;  // sum of the forces on it [N]
};

}  // namespace presa
