#pragma once
#include <vector>

#include "framework/core/math/spatial.h"

namespace presa {

/// A fingertip that presses on a body with Coulomb friction: |f_t| <= friction f_n, and a torque about the normal of at
/// most torsion * friction * f_n, independently of f_t, as Presa's torsional friction has it (a real disc that also
/// slides holds less torque).
struct GraspContact {
  Vec3 p = Vec3::Zero();        ///< where the force acts [m]
  Vec3 inward = Vec3::UnitZ();  ///< unit normal, from the finger into the body
  double friction = 0;          ///< coefficient of static friction
  double torsion = 0;           ///< torsional radius [m]; 0: a point contact
  double max_normal = 1;        ///< bound of the normal force [N], for GripBound::kEach
};

/// Snapshot of a grasp, all in one frame of any choice.
struct GraspSnapshot {
  Vec3 centre = Vec3::Zero();  ///< the body's centre of mass; wrenches are taken about it [m]
  double length = 1;           ///< characteristic length that turns torques into forces [m]
  std::vector<GraspContact> contacts;
};

/// Characteristic length of a body that does not depend on its grasp: root mean square distance of its mass from the
/// centre of mass [m]. Half an edge for a cube. `inertia` about the centre of mass [kg m^2].
double gyrationLength(double mass, const Mat3& inertia);

/// A wrench (f, torque / length) or a motion (v, length * angular velocity) about the centre of mass, so that their
/// scalar product is the power.
using Vec6 = Eigen::Matrix<double, 6, 1>;

}  // namespace presa
