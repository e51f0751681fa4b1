#pragma once
#include "framework/geometry/tri_mesh.h"
#include "framework/haptics/virtual_coupling.h"

namespace presa {

/// The inertia of one tool, as implicit Euler sees it: linear momentum of its centre of mass and angular momentum about
/// it, which a tick changes at its end. The tool has no weight. Thread: haptic; nonblocking.
class ToolMass {
 public:
  /// A solid of this mass [kg] with the volume of the closed `mesh` in T. Throws std::invalid_argument: it has none.
  ToolMass(double mass, const TriMesh& mesh);

  /// The tool is at X_WT and moves with the handle: velocity [m/s] and angular velocity [rad/s].
  void start(const Pose& X_WT, const Vec3& v_W, const Vec3& w_W) noexcept;
  /// Force of inertia on a tool that ends this tick of `period` [s] at X_WT: about its origin, in T [N, N m]. Adds what
  /// resists a motion of the tool in T to `stiffness`.
  Vec6 wrench(const Pose& X_WT, double period, Mat6& stiffness) const noexcept;
  /// The tick ends at X_WT.
  void finish(const Pose& X_WT, double period) noexcept;

 private:
  Vec3 momentumAt(const Pose& X_WT, double period) const noexcept;  // angular

  double mass_;
  Vec3 centre_T_;
  Mat3 inertia_T_;  // about the centre of mass [kg m^2]
  Pose X_WT_;       // at the end of the last tick
  Vec3 v_W_ = Vec3::Zero(), momentum_W_ = Vec3::Zero();
};

}  // namespace presa
