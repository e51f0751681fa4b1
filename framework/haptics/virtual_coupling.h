#pragma once
#include "framework/core/math/spatial.h"
#include "framework/scene/scene.h"

namespace presa {

using Vec6 = Eigen::Matrix<double, 6, 1>;  ///< force [N] and torque [N m], or motion [m] and turn [rad]
using Mat6 = Eigen::Matrix<double, 6, 6>;  ///< such as a stiffness

/// What the spring-damper between handle and tool does to the tool, about the tool's origin, in the world frame.
struct CouplingForce {
  Vec6 wrench = Vec6::Zero();     ///< on the tool [N, N m]
  Mat6 stiffness = Mat6::Zero();  ///< resistance to the tool's motion and turn in this tick, positive definite
};

/// A force that grows as `wanted` up to half of `max` and then approaches `max`; its slope is continuous.
inline Vec3 saturated(const Vec3& wanted, double max) noexcept {
  const double part = wanted.norm() / max;
  return part <= 0.5 ? wanted : Vec3((1 - 1 / (4 * part)) / part * wanted);
}

/// Virtual coupling [Colgate1995] of a tool at X_WT with its handle at X_WH. `moved`: motion and turn of the tool less
/// that of the handle within this tick of `period` [s]. The stiffness is that of small displacements, which is an upper
/// bound beyond half of the limits. It damps each motion of the tool against the handle or, if `damping_along`, as the
/// lectures do: v_d = (v . d) d / |d|^2 along the displacement d of the handle against the tool at the end of the last
/// tick, nothing while the tool moves away; likewise turns. Thread: any; nonblocking.
CouplingForce couplingForce(const ToolCoupling& coupling, const Pose& X_WH, const Pose& X_WT, const Vec6& moved,
                            double period) noexcept;

/// Adds the resistance of a point at p, which resists its own motion by S [N/m], to motion and turn of the tool about
/// the origin of p.
void addStiffness(const Mat3& S, const Vec3& p, Mat6& stiffness) noexcept;

/// Turn that takes orientation `from` to `to`, about an axis in the world frame [rad], at most pi.
Vec3 turnBetween(const Quat& from, const Quat& to) noexcept;

/// X_WT moved by `step` and turned by it about its origin, in the world frame.
Pose movedBy(const Pose& X_WT, const Vec6& step) noexcept;

}  // namespace presa
